#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/queue_records.h"

layout(set = 0, binding = 0) readonly buffer Entries { uint entries[]; };
layout(set = 0, binding = 1) readonly buffer Cells { uint cells[]; };
layout(set = 0, binding = 2) readonly buffer Blocks { QueueBlock blocks[]; };
layout(set = 0, binding = 3) readonly buffer Emptied { uint emptied[]; };
layout(set = 0, binding = 4) writeonly buffer Flags { uint flags[]; };
layout(set = 0, binding = 5) readonly buffer Ends { QueuePathEnd ends[]; };
layout(push_constant) uniform Push { QueueParams params; };

// Whether the paths of photons are kept.
layout(constant_id = 0) const bool keeps_paths = false;

#include "shared/kernels/photon/queue_keep.h"
