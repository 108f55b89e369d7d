#include "shared/kernels/photon/cover.h"

// Hits on another triangle whose barycentric weights are all above this are no hits on a neighbour,
// at the edge that a sample's rounded position has crossed.
CONSTANT real least_inside = real(0.002);

// Whether the triangle that was hit where the sample lies is a copy of the sample's, and does not
// only touch it. Rays hit one of such triangles, and only its area counts.
FN bool is_copy(HitRecord hit) {
    return min(min(hit.u, hit.v), real(1.0) - hit.u - hit.v) > least_inside;
}

FN bool faces_same_way(HitRecord hit, uint packed_normal) {
    uvec4 t = triangles[hit.triangle];
    vec3 a = vec3(positions[t.x]);
    vec3 normal = cross3(vec3(positions[t.y]) - a, vec3(positions[t.z]) - a);
    return dot3(normal, unpack_photon_normal(packed_normal)) > real(0.0);
}

// Takes the area from those sides of area samples on which another surface lies through which no
// light passes.
FN void main() {
    uint thread = THREAD_INDEX;
    uint i;
    if (!find_hit(thread, i)) {
        return;
    }
    uint side = params.first + i;
    uint slot = counters[counter_stored_slots] + side / 2u;
    HitRecord hit = hits[i];
    real height = rays[i].t_max - params.error; // of the start over the sample
    bool is_above = !(hit.t > height - params.error);
    if (hit.triangle == photons[slot].direction || (!is_above && !is_copy(hit))) {
        return;
    }
    MaterialRecord material = load_material(triangles[hit.triangle].w);
    if (passes_light(material)) {
        if (is_above) {
            go_on_behind(thread, i, hit.t);
        }
        return;
    }
    if (!is_above) {
        photons[slot].flux_b = real(0.0);
        if (!faces_same_way(hit, photons[slot].normal)) {
            return; // light from this side arrives at the sample's own triangle
        }
    }
    if (side % 2u == 0u) {
        photons[slot].flux_r = real(0.0);
    } else {
        photons[slot].flux_g = real(0.0);
    }
}
