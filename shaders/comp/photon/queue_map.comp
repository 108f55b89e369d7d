#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/photon_records.h"
#include "shared/queue_records.h"

layout(set = 0, binding = 0) readonly buffer Entries { uint entries[]; };
layout(set = 0, binding = 1) readonly buffer Cells { uint cells[]; };
layout(set = 0, binding = 2) readonly buffer Blocks { QueueBlock blocks[]; };
layout(set = 0, binding = 3) readonly buffer Scales { float scales[]; };
layout(set = 0, binding = 4) readonly buffer Stored { PhotonRecord stored[]; };
layout(set = 0, binding = 5) writeonly buffer Sorted { PhotonRecord sorted[]; };
layout(set = 0, binding = 6) readonly buffer Weights { float weights[]; };
layout(set = 0, binding = 7) readonly buffer Lights { uint stored_lights[]; };
layout(set = 0, binding = 8) readonly buffer Emptied { uint emptied[]; };
layout(set = 0, binding = 9) readonly buffer Ends { QueuePathEnd ends[]; };
layout(push_constant) uniform Push { QueueParams params; };

// Whether photons keep the index of their light.
layout(constant_id = 0) const bool keeps_lights = false;
// Whether the paths of photons are kept.
layout(constant_id = 1) const bool keeps_paths = false;

#include "shared/kernels/photon/queue_map.h"
