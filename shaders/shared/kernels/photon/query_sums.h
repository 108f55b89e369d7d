// The sums of a query between two dispatches (GatherRecord).
#include "shared/kernels/photon/query.h"

// Contributions of a few photons, which are added up before they are added to the query's
// compensated sums.
struct LeafSums {
    vec3 indirect, caustic;
    real area; // of area samples, weighted
    Moments moments;
};

FN LeafSums no_leaf_sums() {
    return LeafSums(vec3(real(0.0)), vec3(real(0.0)), real(0.0), no_moments());
}

FN void load_sums(INOUT(Query) q) {
    GatherRecord g = gathers[q.slot];
    q.indirect.value = vec3(g.indirect_r, g.indirect_g, g.indirect_b);
    q.caustic.value = vec3(g.caustic_r, g.caustic_g, g.caustic_b);
    q.indirect.compensation =
        vec3(g.indirect_compensation_r, g.indirect_compensation_g, g.indirect_compensation_b);
    q.caustic.compensation =
        vec3(g.caustic_compensation_r, g.caustic_compensation_g, g.caustic_compensation_b);
    q.coverage = g.coverage;
    q.moments = moments_of(g);
    q.node = g.node;
}

FN void store_sums(IN(Query) q) {
    vec3 a = q.indirect.compensation;
    vec3 b = q.caustic.compensation;
    Moments m = q.moments;
    gathers[q.slot] = GatherRecord(
        q.indirect.value.x, q.indirect.value.y, q.indirect.value.z, q.node, q.caustic.value.x,
        q.caustic.value.y, q.caustic.value.z, q.coverage, a.x, a.y, a.z, m.square, b.x, b.y, b.z,
        m.weight, m.flux_offset.x, m.flux_offset.y, m.flux_offset.z, m.area_offset.x,
        m.area_offset.y, m.area_offset.z, m.weight_square);
}
