// Walks through a tree over points from leaf to leaf in depth-first order, by escape references
// instead of a stack. NODES(i) reads the tree.
uint walk_end = lbvh_end; // the node that ends the walk

// Squared distance of p from a box, given the words of its corners.
FN real distance2_to_box(vec3 p, uvec4 low, uvec4 high) {
    vec3 outside =
        max(max(bits_float(uvec3(low)) - p, p - bits_float(uvec3(high))), vec3(real(0.0)));
    return dot3(outside, outside);
}

// The photons i of a leaf: first <= i < end.
struct PhotonRange {
    uint first, end;
};

// The next leaf, from `node` on, whose box a ball about p touches; empty at the end of the walk or
// after `limit` steps. This loop is separate from the loop over photons, so that all lanes of a
// subgroup first look for a leaf and then go through their leaves together: 2.2 times as fast on
// lavapipe.
FN PhotonRange next_leaf(vec3 p, real radius2, uint limit, INOUT(uint) node, INOUT(uint) steps) {
    PhotonRange range = PhotonRange(0u, 0u);
    while (range.end == 0u && node != lbvh_end && steps < limit) {
        ++steps;
        uvec4 low = NODES(2u * node);
        uvec4 high = NODES(2u * node + 1u);
        bool near = distance2_to_box(p, low, high) <= radius2;
        bool leaf = (node & 1u) != 0u;
        if (near && leaf) {
            uint first = low.w & leaf_first_mask;
            range = PhotonRange(first, first + (low.w >> leaf_first_bits) + 1u);
        }
        node = near && !leaf ? low.w : high.w;
        node = node == walk_end ? lbvh_end : node;
    }
    return range;
}
