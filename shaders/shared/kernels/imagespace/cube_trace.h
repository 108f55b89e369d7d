// Finds the hits of rays in cube maps.
#include "shared/kernels/count.h"

#include "shared/kernels/imagespace/cube_search.h"

FN void main() {
    uint i = THREAD_INDEX;
    if (i >= ELEMENT_COUNT) {
        return;
    }
    uint index = active_rays[i];
    Search search;
    begin(index, search);
    bool is_ray = rays[index].t_max >= float32(0.0);
    if (is_ray && !search.escapes) {
        search_maps(search);
    }
    if (search.hit.triangle == no_triangle && search.escapes) {
        search.hit.u = ray_escaped;
    }
    hits[index] = search.hit;
}
