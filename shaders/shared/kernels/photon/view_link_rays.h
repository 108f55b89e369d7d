#include "shared/kernels/photon/corrected.h"
#include "shared/kernels/photon/view_link.h"

// Writes a ray from each photon, or from each side of the area samples, to the point in view of its
// own cell. Where no point in view is near, nothing tells whether a wall is before the place, and
// it counts as linked. Caustic photons keep their sharp light wherever they lie.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    LinkedPlace place = linked_place(i);
    PhotonRecord record = photons[place.slot];
    bool tested = record.normal != no_photon && !photon_is_caustic(record.normal);
    if (params.sides == 2u) {
        tested = (place.side == 0u ? record.flux_r : record.flux_g) > float32(0.0);
    }
    RayRecord ray = no_ray(no_view_link);
    if (tested && is_in_corrected_part(place.p)) {
        uvec4 cell = view_cell(place.p, place.normal, params.cells);
        uint bit = view_filter_bit(cell, params.mask);
        if ((tested_cells[bit >> 5u] & (1u << (bit & 31u))) != 0u) {
            ViewPointRecord point;
            if (!find_view_point(cell, point) || !ray_to_view_point(place, point, ray)) {
                ray = no_ray(unknown_view_link);
            }
        }
    }
    rays[i] = ray;
    active_slots[i] = i;
}
