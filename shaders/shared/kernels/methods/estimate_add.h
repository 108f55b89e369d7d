#include "shared/kernels/layers.h"

// Adds the estimates from the photon map to the layers of the paths that have queries. An estimate
// whose disc hardly lies on surfaces is not taken: on leaves and bars much thinner than the disc,
// its few area samples do not tell its share. Nor is one of too uneven light (uneven.h). There the
// path that seeks emission goes on, and queries the map at its next vertex, as in a final gather.
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
    bool gathers = (flags & query_gathers) != 0u;
    bool taken = !(e.coverage < params.least_coverage || e.uneven > params.most_uneven);
    if (!taken) {
        paths[slot].state &= ~path_seeks_emission;
    }
    if (taken && (flags & query_caustics) == 0u) {
        add_to_layer(slot, layer_indirect, gathers ? indirect + caustic : indirect);
    }
    // Paths find no caustics behind the first estimated vertex, but all light behind the next ones.
    if (!gathers) {
        add_to_layer(slot, layer_caustic, caustic);
    }
}
