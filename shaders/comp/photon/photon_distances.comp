#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/maths.h"
#include "shared/morton.h"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 2) readonly buffer Bounds { vec4 bounds[]; };
layout(set = 0, binding = 3) readonly buffer Points { vec4 points[]; };
layout(set = 0, binding = 4) writeonly buffer Distances { float distances[]; };
layout(push_constant) uniform Push { PhotonDistanceParams params; };

#include "shared/kernels/photon/photon_distances.h"
