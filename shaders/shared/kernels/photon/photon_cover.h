#include "shared/kernels/photon/cover.h"

// Drops the photons over which another surface lies through which no light passes. Area there does
// not count either (area_cover).
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count || hits[i].triangle == no_triangle) {
        return;
    }
    MaterialRecord material = load_material(triangles[hits[i].triangle].w);
    if (passes_light(material)) {
        go_on_behind(i, hits[i].t);
        return;
    }
    photons[params.first + i].normal = no_photon;
    rays[i].t_max = -real(1.0);
}
