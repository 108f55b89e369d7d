#include "shared/kernels/photon/queue_box_read.h"

// The leaf of each cell: its box, its first records in the map, how many further leaves its records
// need, how many records it holds if these are too many, and the factor by which the weights of its
// photons' blocks sum to 1.
FN void main() {
    uint cell = THREAD_INDEX;
    if (cell >= params.cells) {
        return;
    }
    uint first = starts[cell];
    uint count = starts[cell + 1u] - first;
    uint in_first = min(count, most_photons_a_leaf);
    leaves[cell] = first | ((max(in_first, 1u) - 1u) << leaf_first_bits);
    more[cell] = (max(count, 1u) - 1u) / most_photons_a_leaf;
    crowded[cell] = count > 2u * params.leaf_size ? count : 0u;
    vec3 low = vec3(far_away);
    vec3 high = -low;
    if (count > 0u) {
        low = low_corner(cell);
        high = high_corner(cell);
    }
    leaf_boxes[cell] = BoxRecord(low.x, low.y, low.z, real(0.0), high.x, high.y, high.z, real(0.0));
    real weight = real(0.0);
    for (uint b = 0u; b < params.blocks; ++b) {
        weight += blocks[b].moment > emptied[cell] ? blocks[b].weight : real(0.0);
    }
    scales[cell] = weight > real(0.0) ? real(1.0) / weight : real(0.0);
}
