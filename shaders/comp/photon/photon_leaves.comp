#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/morton.h"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Distances { uint distances[]; };
layout(set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) writeonly buffer Leaves { uint leaves[]; };
layout(set = 0, binding = 3) writeonly buffer Heads { uint heads[]; };
layout(push_constant) uniform Push { PhotonLeafParams params; };

#include "shared/kernels/photon/photon_leaves.h"
