#include "shared/kernels/photon/queue_box_read.h"

// Empties the cells whose boxes come near one that a surface has left or entered: photons of
// earlier blocks are dropped there.
FN void main() {
    uint cell = THREAD_INDEX;
    if (cell >= params.cells || is_untouched(cell)) {
        return;
    }
    vec3 low = low_corner(cell) - vec3(params.reach);
    vec3 high = high_corner(cell) + vec3(params.reach);
    for (uint i = 0u; i < params.count; ++i) {
        BoxRecord m = moved[i];
        vec3 gap =
            max(low - vec3(m.high_x, m.high_y, m.high_z), vec3(m.low_x, m.low_y, m.low_z) - high);
        if (max_component(gap) <= real(0.0)) {
            emptied[cell] = params.moment;
            return;
        }
    }
}
