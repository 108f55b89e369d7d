#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/query_cell.h"
#include "shared/query_record.h"

layout(set = 0, binding = 0) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer QueryKinds { uint query_kinds[]; };
layout(set = 0, binding = 3) readonly buffer Queries { QueryRecord queries[]; };
// Which entry of the table a cell of queries gets depends on who comes first; its owner does not.
//@ incidental(table)
//@ incidental(owners)
//@ refers(sources, owners)
layout(set = 0, binding = 4) coherent buffer Table { uint table[]; };
layout(set = 0, binding = 5) coherent buffer Owners { uint owners[]; };
layout(set = 0, binding = 6) writeonly buffer Sources { uint sources[]; };
layout(set = 0, binding = 7) readonly buffer QueryBsdfs { QueryBsdfRecord query_bsdfs[]; };
layout(push_constant) uniform Push { QueryShareParams params; };

#include "shared/kernels/methods/query_cells.h"
