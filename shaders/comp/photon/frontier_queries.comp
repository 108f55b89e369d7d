#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/frontier.h"
#include "shared/maths.h"
#include "shared/photon_records.h"
#include "shared/query_record.h"
#include "shared/segments.h"

layout(set = 0, binding = 0) readonly buffer Slots { uint active_slots[]; };
layout(set = 0, binding = 1) readonly buffer Queries { QueryRecord queries[]; };
layout(set = 0, binding = 2) writeonly buffer Places { uvec4 places[]; };
layout(set = 0, binding = 3) writeonly buffer Segments { uint segments[]; };
layout(set = 0, binding = 4) writeonly buffer Gathers { GatherRecord gathers[]; };
layout(push_constant) uniform Push { FrontierParams params; };

#include "shared/kernels/photon/frontier_queries.h"
