#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/footprint.h"
#include "shared/photon.h"
#include "shared/queue_records.h"

layout(set = 0, binding = 0) readonly buffer Entries { uint entries[]; };
layout(set = 0, binding = 1) readonly buffer Cells { uint cells[]; };
layout(set = 0, binding = 2) readonly buffer Blocks { QueueBlock blocks[]; };
layout(set = 0, binding = 3) readonly buffer Stored { PhotonRecord stored[]; };
layout(set = 0, binding = 4) readonly buffer Offsets { uvec4 stored_offsets[]; };
layout(set = 0, binding = 5) writeonly buffer Footprints { uvec4 footprints[]; };
layout(set = 0, binding = 6) writeonly buffer Shares { uint shares[]; };
layout(set = 0, binding = 7) buffer Boxes { uint boxes[]; };
layout(push_constant) uniform Push { QueueFootprintParams params; };

#include "shared/kernels/photon/queue_footprints.h"
