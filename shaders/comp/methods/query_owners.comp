#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/query_cell.h"
#include "shared/query_record.h"

layout(set = 0, binding = 0) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer Owners { uint owners[]; };
layout(set = 0, binding = 3) readonly buffer Asks { uint asks[]; };
layout(set = 0, binding = 4) buffer Sources { uint sources[]; };
layout(set = 0, binding = 5) writeonly buffer Chosen { uint chosen[]; };
layout(push_constant) uniform Push { QueryShareParams params; };

// Of the entry of its cell (none: it has one of its own), makes the slot whose answer each query takes; only that one
// is chosen to ask.
void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[0]) {
        return;
    }
    chosen[i] = 0u;
    if (asks[i] != params.asks) {
        return;
    }
    uint slot = active_slots[i];
    uint entry = sources[slot];
    uint owner = entry == no_query ? slot : slot_of_shuffled(owners[entry]);
    sources[slot] = owner;
    chosen[i] = owner == slot ? 1u : 0u;
}
