// Queries that take one walk through the map and may be suspended between two dispatches.
#include "shared/kernels/photon/query.h"

// Contributions of one leaf's photons, which are added up before they are added to the query's
// compensated sums.
struct LeafSums {
    vec3 indirect, caustic;
    real area; // of area samples, weighted
};

// The query of this invocation, as it was suspended if this is not its first dispatch. False: there
// is none, or it is complete.
FN bool load_query(OUT(Query) q) {
    uint i = THREAD_INDEX;
    if (i >= counts[params.count_index]) {
        return false;
    }
    q = make_query(active_slots[i]);
    if (params.first == 0u) {
        GatherRecord g = gathers[q.slot];
        q.indirect.value = vec3(g.indirect_r, g.indirect_g, g.indirect_b);
        q.caustic.value = vec3(g.caustic_r, g.caustic_g, g.caustic_b);
        q.indirect.compensation =
            vec3(g.indirect_compensation_r, g.indirect_compensation_g, g.indirect_compensation_b);
        q.caustic.compensation =
            vec3(g.caustic_compensation_r, g.caustic_compensation_g, g.caustic_compensation_b);
        q.coverage = g.coverage;
        q.node = g.node;
    }
    return params.first != 0u || q.node != lbvh_end;
}

// Suspends the query if its walk has not reached the end; else stores the estimate, times the
// scales.
FN void store_query(IN(Query) q, real indirect_scale, real caustic_scale) {
    if (q.node != lbvh_end) {
        vec3 a = q.indirect.compensation;
        vec3 b = q.caustic.compensation;
        gathers[q.slot] =
            GatherRecord(q.indirect.value.x, q.indirect.value.y, q.indirect.value.z, q.node,
                         q.caustic.value.x, q.caustic.value.y, q.caustic.value.z, q.coverage, a.x,
                         a.y, a.z, real(0.0), b.x, b.y, b.z, real(0.0));
        atomicAdd(unfinished[0], 1u);
        return;
    }
    gathers[q.slot].node = lbvh_end;
    store_estimate(q, indirect_scale * q.indirect.value, caustic_scale * q.caustic.value);
}
