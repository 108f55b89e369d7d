#include "shared/kernels/photon/queue_box.h"

// Copies the records of a block, in the order of their cells, to where the queue stores them, and
// lets the cells' boxes grow around them.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count || cells[i] >= params.cells) {
        return;
    }
    uint slot = params.first + order[i];
    uint place = blocks[params.block].first + i;
    PhotonRecord p = photons[slot];
    stored[place] = p;
    if (footprints) {
        stored_offsets[place] = offsets[slot];
    }
    if (keeps_lights) {
        stored_lights[place] = photon_lights[slot];
    }
    if (keeps_paths) {
        QueuePathEnd end = QueuePathEnd(params.first_vertex + slot, 0u);
        if (!new_paths) {
            end = ends[slot];
        }
        stored_ends[place] = end;
    }
    grow(cells[i], vec3(p.x, p.y, p.z), vec3(p.x, p.y, p.z));
}
