#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/kdtree.h"
#include "shared/morton.h"
#include "shared/photon.h"
#include "shared/queue_records.h"

layout(set = 0, binding = 0) readonly buffer Words { uint words[]; };
layout(set = 0, binding = 1) readonly buffer Addresses { uint addresses[]; };
layout(set = 0, binding = 2) writeonly buffer Distances { uint distances[]; };
layout(push_constant) uniform Push { QueueParams params; };

#include "shared/kernels/photon/queue_kd_distances.h"
