#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/query_cell.h"
#include "shared/query_record.h"

layout(set = 0, binding = 0) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer Asks { uint asks[]; };
layout(set = 0, binding = 3) readonly buffer Queries { QueryRecord queries[]; };
layout(set = 0, binding = 4) coherent buffer Table { uint table[]; };
layout(set = 0, binding = 5) coherent buffer Owners { uint owners[]; };
layout(set = 0, binding = 6) writeonly buffer Sources { uint sources[]; };
layout(push_constant) uniform Push { QueryShareParams params; };

bool shares(QueryRecord q) { return params.cell > 0.0 && (q.flags & query_white) != 0u; }

uvec4 cell_of(QueryRecord q) {
    vec3 p = vec3(q.x, q.y, q.z);
    vec3 from_eye = p - vec3(params.eye_x, params.eye_y, params.eye_z);
    float pixel = params.pixel + params.pixel_slope * sqrt(dot3(from_eye, from_eye));
    return query_cell(p, unpack_unit(q.geometric_normal), params.cell, pixel);
}

// Finds each query's entry of a hash table of cells; the least of a cell's shuffled slots is its owner, whatever the order
// in which they come. A table has more entries than there are slots.
void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[0]) {
        return;
    }
    uint slot = active_slots[i];
    uint source = no_query;
    if (asks[i] != 0u) {
        QueryRecord q = queries[slot];
        if (shares(q)) {
            uvec4 cell = cell_of(q);
            uint entry = pcg4d(cell).x & params.mask;
            for (;;) {
                uint other = atomicCompSwap(table[entry], no_query, slot);
                if (other == no_query || other == slot || cell_of(queries[other]) == cell) {
                    break;
                }
                entry = (entry + 1u) & params.mask;
            }
            atomicMin(owners[entry], shuffled_slot(slot));
            source = entry;
        }
    }
    sources[slot] = source;
}
