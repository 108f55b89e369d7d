#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/footprint.h"
#include "shared/frontier.h"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Boxes { BoxRecord boxes[]; };
layout(set = 0, binding = 2) writeonly buffer Flags { uint flags[]; };
layout(set = 0, binding = 3) readonly buffer Footprints { uvec4 footprints[]; };
layout(set = 0, binding = 4) writeonly buffer Extents { vec4 extents[]; };
layout(push_constant) uniform Push { FrontierParams params; };
// Whether photons reach as far as their footprints, whose extents are written.
layout(constant_id = 0) const bool of_footprints = false;

#include "shared/kernels/photon/frontier_enter.h"
