// As queue_cells, where the cells are the leaves of a kd-tree.
FN uint cell_at(vec3 p) {
    uint node = 0u;
    while (!kd_is_leaf(words[node])) {
        uint parent = words[node + 1u];
        node = kd_is_left(kd_at(p, kd_axis(parent)), bits_float(words[node + 2u]))
                   ? kd_left_child(node)
                   : kd_right_child(parent);
    }
    return kd_node_index(words[node]);
}

#include "shared/kernels/photon/queue_sort.h"
