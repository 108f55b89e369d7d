// Queries that take one walk through the map's tree and may be suspended between two dispatches.
#include "shared/kernels/photon/query_sums.h"

#include "shared/kernels/photon/answer.h"
#include "shared/kernels/photon/map_walk.h"

// The query of this invocation, as it was suspended if this is not its first dispatch. False: there
// is none, or it is complete.
FN bool load_query(OUT(Query) q) {
    uint i = THREAD_INDEX;
    if (i >= counts[params.count_index]) {
        return false;
    }
    q = make_query(active_slots[i]);
    q.node = first_node(params.part); // also where the walk ends
    if (params.first == 0u) {
        load_sums(q);
    }
    return params.first != 0u || q.node != lbvh_end;
}

// Suspends the query if its walk has not reached the end; else stores the estimate, times the
// scales, and the coverage that they follow from.
FN void store_query(IN(Query) q, real indirect_scale, real caustic_scale, real coverage) {
    if (q.node != lbvh_end) {
        store_sums(q);
        atomicAdd(unfinished[0], 1u);
        return;
    }
    gathers[q.slot].node = lbvh_end;
    store_estimate(q.slot, indirect_scale * q.indirect.value, caustic_scale * q.caustic.value,
                   coverage, known_unevenness(q.p, q.moments, q.indirect.value, q.coverage));
}
