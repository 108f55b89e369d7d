#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/footprint.h"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Footprints { uvec4 footprints[]; };
layout(set = 0, binding = 2) readonly buffer Points { vec4 points[]; };
layout(set = 0, binding = 3) writeonly buffer Distances { float distances[]; };
layout(push_constant) uniform Push { FootprintDistanceParams params; };

#include "shared/kernels/photon/footprint_distances.h"
