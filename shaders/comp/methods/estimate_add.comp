#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/path_records.h"
#include "shared/query_record.h"

layout(set = 0, binding = 0) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer Sources { uint sources[]; };
layout(set = 0, binding = 3) readonly buffer Queries { QueryRecord queries[]; };
layout(set = 0, binding = 4) readonly buffer Estimates { EstimateRecord estimates[]; };
layout(set = 0, binding = 5) buffer Layers { LayersRecord layers[]; };
layout(set = 0, binding = 6) buffer Paths { PathRecord paths[]; };
layout(push_constant) uniform Push { EstimateAddParams params; };

#include "shared/kernels/methods/estimate_add.h"
