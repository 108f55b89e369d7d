// Adds photons of a leaf to the sums of its queries, one query to an invocation. Queries of a leaf
// lie side by side, so neighbouring invocations read the same references. The including file
// defines the estimator (query_walk.h).
FN void main() {
    uint i = params.first + THREAD_INDEX;
    if (i >= params.end || segments[i] == no_segment) {
        return;
    }
    FrontierNode node = frontier[segments[i]];
    if (node.state != frontier_leaf || node.count <= params.first_photon) {
        return;
    }
    Query q = make_query(places[i].w);
    load_sums(q);
    Bandwidth bandwidth = make_bandwidth();
    uint end = node.first + min(node.count, params.first_photon + params.photons);
    for (uint j = node.first + params.first_photon; j < end;) {
        // As many as in a leaf of the map's tree are summed up before they are added.
        uint block_end = min(j + 16u, end);
        LeafSums leaf = no_leaf_sums();
        for (; j < block_end; ++j) {
            uvec4 photon = REFERENCES(j);
            if (may_reach(bandwidth, bits_float(uvec3(photon)) - q.p)) {
                add_photon(bandwidth, photon.w, q, leaf);
            }
        }
        add_leaf(bandwidth, leaf, q);
    }
    store_sums(q);
}
