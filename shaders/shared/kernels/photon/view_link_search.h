#include "shared/kernels/photon/view_link.h"
#include "shared/kernels/photon/view_link_drop.h"

// Writes the next ray of the places that view_links marked: to a point in view in the cells around
// their own, ring by ring, farther than those of the searches before. Without one, a place whose
// rays were blocked is dropped.
FN void main() {
    uint thread = THREAD_INDEX;
    if (thread >= counters[params.counter]) {
        return;
    }
    uint i = active_slots[thread];
    LinkedPlace place = linked_place(i);
    real last = rays[i].t_max;
    real beyond = params.searches == 0u ? real(0.0) : last;
    uvec4 own = view_cell(place.p, place.normal, params.cells);
    uint axis = own.w / 2u;
    real height = axis == 0u ? place.p.x : (axis == 1u ? place.p.y : place.p.z);
    height = in_view_cells(height, params.cells);
    uint other_layer = height - floor(height) < real(0.5) ? 0xffffffffu : 1u;
    RayRecord nearest = no_ray(no_view_link);
    for (int ring = 0; ring <= view_cell_rings && nearest.t_max < real(0.0); ++ring) {
        int across = 2 * ring + 1;
        for (int j = 0; j < 2 * across * across; ++j) {
            int a = j % across - ring;
            int b = j / across % across - ring;
            if (max(abs(a), abs(b)) < ring) {
                continue; // in a ring before
            }
            uint layer = j < across * across ? 0u : other_layer;
            if (ring == 0 && layer == 0u) {
                continue; // the first ray went there
            }
            uvec4 cell = own;
            cell.x += axis == 0u ? layer : uint(a);
            cell.y += axis == 1u ? layer : uint(axis == 0u ? a : b);
            cell.z += axis == 2u ? layer : uint(b);
            ViewPointRecord point;
            RayRecord ray;
            if (find_view_point(cell, point) && ray_to_view_point(place, point, ray) &&
                ray.t_max > beyond && (nearest.t_max < real(0.0) || ray.t_max < nearest.t_max)) {
                nearest = ray;
            }
        }
    }
    rays[i] = nearest;
    if (nearest.t_max < real(0.0) && last > real(0.0)) {
        drop_unlinked(place);
    }
}
