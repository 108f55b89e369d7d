#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/photon_records.h"
#include "shared/queue_records.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Cells { uint cells[]; };
layout(set = 0, binding = 2) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 3) readonly buffer Blocks { QueueBlock blocks[]; };
layout(set = 0, binding = 4) buffer Boxes { uint boxes[]; };
layout(set = 0, binding = 5) writeonly buffer Stored { PhotonRecord stored[]; };
layout(set = 0, binding = 6) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 7) writeonly buffer StoredOffsets { uvec4 stored_offsets[]; };
layout(set = 0, binding = 8) readonly buffer Lights { uint photon_lights[]; };
layout(set = 0, binding = 9) writeonly buffer StoredLights { uint stored_lights[]; };
layout(set = 0, binding = 10) readonly buffer Ends { QueuePathEnd ends[]; };
layout(set = 0, binding = 11) writeonly buffer StoredEnds { QueuePathEnd stored_ends[]; };
layout(push_constant) uniform Push { QueueParams params; };

// Whether photons carry differentials.
layout(constant_id = 0) const bool footprints = false;
// Whether photons keep the index of their light.
layout(constant_id = 1) const bool keeps_lights = false;
// Whether the paths of photons are kept, and whether they are those of new photons.
layout(constant_id = 2) const bool keeps_paths = false;
layout(constant_id = 3) const bool new_paths = false;

#include "shared/kernels/photon/queue_store.h"
