#include "shared/kernels/photon/queue_in_leaf.h"

// Lists the records in each cell, as queue_leaf_count counts them. places: where each cell's next
// record goes. params.block: number of the first record tested among those of the block.
FN void main() {
    uint cell = THREAD_INDEX;
    if (cell >= params.cells) {
        return;
    }
    BoxRecord extent = extent_of(cell);
    uint place = places[cell];
    for (uint i = 0u; i < params.count; ++i) {
        if (is_in_leaf(photons[params.first + i], cell, extent)) {
            cells[place] = cell;
            order[place] = params.block + i;
            ++place;
        }
    }
    places[cell] = place;
}
