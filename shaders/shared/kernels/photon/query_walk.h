// One walk of a query through the map, from leaf to leaf, which may be resumed in a later dispatch.
// The including file defines the estimator, as disc_density.h and footprint_density.h do:
// - Bandwidth make_bandwidth(): what it needs to know for every query;
// - real search_radius2(Bandwidth): square of the distance within which a leaf's box counts;
// - bool may_reach(Bandwidth, vec3 d): whether a photon at the end of chord d may count;
// - void add_photon(Bandwidth, uint j, Query, LeafSums): adds photon j;
// - void add_leaf(Bandwidth, LeafSums, Query): adds the sums of a few photons to the query's;
// - real caustic_scale(Bandwidth, real): from the scale of indirect light.
FN void main() {
    Query q;
    if (!load_query(q)) {
        return;
    }
    Bandwidth bandwidth = make_bandwidth();
    uint steps = 0u;
    for (;;) {
        PhotonRange range = next_leaf(q.p, search_radius2(bandwidth), params.budget, q.node, steps);
        if (range.end == 0u) {
            break;
        }
        LeafSums leaf = no_leaf_sums();
        steps += range.end - range.first;
        for (uint j = range.first; j < range.end; ++j) {
            add_photon(bandwidth, j, q, leaf);
        }
        add_leaf(bandwidth, leaf, q);
    }
    real coverage = known_coverage(q.p, q.coverage);
    real scale = answer_scale(coverage);
    store_query(q, scale, caustic_scale(bandwidth, scale), coverage);
}
