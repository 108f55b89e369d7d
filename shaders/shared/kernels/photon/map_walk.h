// Walks through a photon map. NODES(i) and PHOTONS(i) read the map.
#include "shared/kernels/photon/leaf_walk.h"

// The first node of the walk through a part of the map (map_*), or lbvh_end if the part is empty.
// Sets walk_end.
FN uint first_node(uint part) {
    uint leaves = counters[counter_leaves];
    uint root = leaves == 0u ? lbvh_end : leaves == 1u ? 1u : 0u;
    walk_end = lbvh_end;
    if (part == map_whole || root == lbvh_end) {
        return root;
    }
    bool first_caustic = photon_is_caustic(PHOTONS(0u).w);
    bool last_caustic = photon_is_caustic(PHOTONS(2u * (counters[counter_stored] - 1u)).w);
    if (first_caustic == last_caustic) {
        return first_caustic == (part == map_caustic) ? root : lbvh_end;
    }
    uint others = NODES(0u).w;
    uint caustic = NODES(2u * others + 1u).w;
    if (part == map_caustic) {
        return caustic;
    }
    walk_end = caustic;
    return others;
}
