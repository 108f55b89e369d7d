#include "shared/kernels/photon/queue_box.h"

// Copies the records of a block, in the order of their cells, to where the queue stores them, and
// lets the cells' boxes grow around them.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count || cells[i] >= params.cells) {
        return;
    }
    PhotonRecord p = photons[params.first + order[i]];
    stored[blocks[params.block].first + i] = p;
    grow(cells[i], vec3(p.x, p.y, p.z), vec3(p.x, p.y, p.z));
}
