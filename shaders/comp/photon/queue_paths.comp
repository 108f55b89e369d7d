#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/geometry_records.h"
#include "shared/photon_records.h"
#include "shared/queue_records.h"

layout(set = 0, binding = 0) readonly buffer Entries { uint entries[]; };
layout(set = 0, binding = 1) readonly buffer Blocks { QueueBlock blocks[]; };
layout(set = 0, binding = 2) readonly buffer Vertices { PathVertex vertices[]; };
layout(set = 0, binding = 3) readonly buffer Moved { BoxRecord moved[]; };
layout(set = 0, binding = 4) readonly buffer Moments { uint moments[]; };
layout(set = 0, binding = 5) buffer Ends { QueuePathEnd ends[]; };
layout(set = 0, binding = 6) writeonly buffer Counts { uint counts[]; };
layout(push_constant) uniform Push { QueueParams params; };

// Whether records keep the moment.
layout(constant_id = 0) const bool marks = false;

#include "shared/kernels/photon/queue_paths.h"
