#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "scene_bindings.glsl"
#include "texture_bindings.glsl"
#include "shared/photon.h"
#include "shared/sobol.h"
#include "shared/triangle_piece.h"

layout(set = 0, binding = 10) readonly buffer AreaSums { AreaSumRecord area_sums[]; };
layout(set = 0, binding = 11) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 12) writeonly buffer Photons { PhotonRecord photons[]; };
layout(push_constant) uniform Push { AreaSampleParams params; };
// Whether parts of surfaces may be absent.
layout(constant_id = 0) const bool has_alpha = true;

#include "shared/kernels/photon/area_samples.h"
