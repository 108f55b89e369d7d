#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/queue_records.h"

layout(set = 0, binding = 0) readonly buffer Cells { uint cells[]; };
layout(set = 0, binding = 1) writeonly buffer Starts { uint starts[]; };
layout(push_constant) uniform Push { QueueParams params; };

#include "shared/kernels/photon/queue_starts.h"
