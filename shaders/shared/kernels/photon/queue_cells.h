FN uint cell_at(vec3 p) {
    uint node = 0u;
    uint link = nodes[0].link;
    while ((link >> cell_axis_shift) != cell_is_leaf) {
        uint axis = link >> cell_axis_shift;
        real coordinate = axis == 0u ? p.x : axis == 1u ? p.y : p.z;
        node = coordinate < nodes[node].split ? node + 1u : link & cell_link_mask;
        link = nodes[node].link;
    }
    return link & cell_link_mask;
}

#include "shared/kernels/photon/queue_sort.h"
