#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/queue_records.h"

layout(set = 0, binding = 0) readonly buffer Entries { uint entries[]; };
layout(set = 0, binding = 1) readonly buffer Blocks { QueueBlock blocks[]; };
layout(set = 0, binding = 2) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 3) readonly buffer Footprints { uvec4 footprints[]; };
layout(set = 0, binding = 4) writeonly buffer Stored { uvec4 stored_offsets[]; };
layout(push_constant) uniform Push { QueueParams params; };

#include "shared/kernels/photon/queue_area_footprints.h"
