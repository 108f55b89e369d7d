#include "shared/kernels/photon/queue_in_leaf.h"

// Counts the records in each cell: an invocation for each cell tests some of them, one after the
// other (Shi 2012, algorithm 1).
FN void main() {
    uint cell = THREAD_INDEX;
    if (cell >= params.cells) {
        return;
    }
    BoxRecord extent = extent_of(cell);
    uint count = counts[cell];
    for (uint i = 0u; i < params.count; ++i) {
        count += is_in_leaf(photons[params.first + i], cell, extent) ? 1u : 0u;
    }
    counts[cell] = count;
}
