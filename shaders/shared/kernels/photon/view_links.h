#include "shared/kernels/material.h"
#include "shared/kernels/passes_light.h"
#include "shared/kernels/photon/linked_place.h"
#include "shared/kernels/photon/view_link_drop.h"

// Marks the places whose ray was blocked, or which have none yet, for a ray to another point in
// view. Drops those whose last one was blocked. Glass blocks no ray, whatever stands behind it.
FN void main() {
    uint thread = THREAD_INDEX;
    if (thread >= counters[params.counter]) {
        return;
    }
    uint i = active_slots[thread];
    uint triangle = hits[i].triangle;
    bool unknown = rays[i].t_max == unknown_view_link;
    bool blocked = triangle != no_triangle && !passes_light(load_material(triangles[triangle].w));
    bool last = params.last != 0u;
    alive[thread] = (unknown || blocked) && !last ? 1u : 0u;
    if (blocked && last) {
        drop_unlinked(linked_place(i));
    }
}
