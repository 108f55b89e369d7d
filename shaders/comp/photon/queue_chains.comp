#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"
#include "shared/photon_records.h"
#include "shared/queue_records.h"

layout(set = 0, binding = 0) readonly buffer Starts { uint starts[]; };
layout(set = 0, binding = 1) readonly buffer Chains { uint chains[]; };
//@ holds(nodes, LbvhNode)
layout(set = 0, binding = 2) buffer Nodes { uvec4 nodes[]; };
layout(push_constant) uniform Push { QueueParams params; };

#include "shared/kernels/photon/queue_chains.h"
