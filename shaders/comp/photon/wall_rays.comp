#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/geometry_records.h"
#include "shared/photon.h"
#include "shared/query_record.h"

layout(set = 0, binding = 0) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer Queries { QueryRecord queries[]; };
layout(set = 0, binding = 3) readonly buffer Estimates { EstimateRecord estimates[]; };
layout(set = 0, binding = 4) writeonly buffer Rays { RayRecord rays[]; };
layout(push_constant) uniform Push { WallParams params; };

#include "shared/kernels/photon/wall_rays.h"
