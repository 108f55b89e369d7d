#include "shared/kernels/photon/cover.h"

// Drops the photons over which another surface lies through which no light passes. Area there does
// not count either (area_cover).
FN void main() {
    uint thread = THREAD_INDEX;
    uint i;
    if (!find_hit(thread, i)) {
        return;
    }
    MaterialRecord material = load_material(triangles[hits[i].triangle].w);
    if (passes_light(material)) {
        go_on_behind(thread, i, hits[i].t);
        return;
    }
    photons[params.first + i].normal = no_photon;
}
