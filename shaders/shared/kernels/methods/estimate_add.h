#include "shared/kernels/layers.h"

// Adds the estimates from the photon map to the layers of the paths that have queries.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[0]) {
        return;
    }
    uint slot = active_slots[i];
    uint source = sources[slot];
    if (source == no_query) {
        return;
    }
    vec3 throughput =
        vec3(queries[slot].throughput_r, queries[slot].throughput_g, queries[slot].throughput_b);
    EstimateRecord e = estimates[source];
    vec3 indirect = throughput * vec3(e.indirect_r, e.indirect_g, e.indirect_b);
    vec3 caustic = throughput * vec3(e.caustic_r, e.caustic_g, e.caustic_b);
    uint flags = queries[slot].flags;
    if ((flags & query_gathers) != 0u) {
        add_to_layer(slot, layer_indirect, indirect + caustic);
        return;
    }
    if ((flags & query_caustics) == 0u) {
        add_to_layer(slot, layer_indirect, indirect);
    }
    add_to_layer(slot, layer_caustic, caustic);
}
