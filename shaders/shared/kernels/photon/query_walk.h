// One walk of a query through the map, from leaf to leaf, and may be resumed in a later dispatch.
// The including file defines the estimator:
// - Bandwidth make_bandwidth(): what it needs to know for every query;
// - real search_radius2(Bandwidth): square of the distance within which leaves count;
// - void add_photon(Bandwidth, uint j, Query, LeafSums): adds photon j of a leaf;
// - void add_leaf(Bandwidth, LeafSums, Query): adds a leaf's sums to the query's;
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
        LeafSums leaf = LeafSums(vec3(real(0.0)), vec3(real(0.0)), real(0.0));
        steps += range.end - range.first;
        for (uint j = range.first; j < range.end; ++j) {
            add_photon(bandwidth, j, q, leaf);
        }
        add_leaf(bandwidth, leaf, q);
    }
    // Photons cover only the part of the kernel's support that lies on surfaces. The area samples
    // give that part once the walk has seen all of them.
    real scale = is_corrected(q) ? real(1.0) / max(q.coverage, least_coverage) : real(1.0);
    store_query(q, scale, caustic_scale(bandwidth, scale));
}
