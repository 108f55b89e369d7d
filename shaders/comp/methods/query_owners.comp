#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/query_cell.h"
#include "shared/query_record.h"

layout(set = 0, binding = 0) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer Owners { uint owners[]; };
layout(set = 0, binding = 3) readonly buffer QueryKinds { uint query_kinds[]; };
layout(set = 0, binding = 4) buffer Sources { uint sources[]; };
layout(set = 0, binding = 5) writeonly buffer Chosen { uint chosen[]; };
layout(push_constant) uniform Push { QueryShareParams params; };

#include "shared/kernels/methods/query_owners.h"
