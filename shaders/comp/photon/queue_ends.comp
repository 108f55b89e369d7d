#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/queue_records.h"

layout(set = 0, binding = 0) readonly buffer Ranks { uint ranks[]; };
layout(set = 0, binding = 1) readonly buffer Starts { uint starts[]; };
layout(set = 0, binding = 2) readonly buffer FreshStarts { uint fresh_starts[]; };
layout(set = 0, binding = 3) writeonly buffer NextStarts { uint next_starts[]; };
layout(push_constant) uniform Push { QueueParams params; };

#include "shared/kernels/photon/queue_ends.h"
