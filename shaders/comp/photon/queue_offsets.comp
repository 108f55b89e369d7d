#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/queue_records.h"

layout(set = 0, binding = 0) readonly buffer Entries { uint entries[]; };
layout(set = 0, binding = 1) readonly buffer Blocks { QueueBlock blocks[]; };
layout(set = 0, binding = 2) readonly buffer Stored { uvec4 stored_offsets[]; };
layout(set = 0, binding = 3) writeonly buffer Offsets { uvec4 offsets[]; };
layout(push_constant) uniform Push { QueueParams params; };

#include "shared/kernels/photon/queue_offsets.h"
