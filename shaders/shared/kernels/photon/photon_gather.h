// Density estimation within a radius.
#include "shared/kernels/photon/query_state.h"

FN void main() {
    Query q;
    if (!load_query(q)) {
        return;
    }
    real r2 = params.radius * params.radius;
    real caustic_r2 = params.caustic_radius * params.caustic_radius;
    real inverse_r2 = real(1.0) / r2;
    real inverse_caustic_r2 = real(1.0) / caustic_r2;
    real half_height = params.radius * disc_half_height;

    uint steps = 0u;
    for (;;) {
        PhotonRange range = next_leaf(q.p, r2, params.budget, q.node, steps);
        if (range.end == 0u) {
            break;
        }
        vec3 indirect_leaf = vec3(real(0.0));
        vec3 caustic_leaf = vec3(real(0.0));
        real area_leaf = real(0.0);
        steps += range.end - range.first;
        for (uint j = range.first; j < range.end; ++j) {
            uvec4 place = PHOTONS(2u * j);
            vec3 d = bits_float(uvec3(place)) - q.p;
            real height = dot3(d, q.normal);
            real d2 = dot3(d, d) - height * height;
            if (!(d2 < r2) || abs(height) > half_height || !on_same_side(q, place.w)) {
                continue;
            }
            uvec4 carried = PHOTONS(2u * j + 1u);
            if ((place.w & area_sample_bit) != 0u) {
                area_leaf += bits_float(carried.x) * kernel_weight(d2 * inverse_r2);
            } else if (is_caustic(place)) {
                caustic_leaf += scattered(q, carried) * kernel_weight(d2 * inverse_caustic_r2);
            } else {
                indirect_leaf += scattered(q, carried) * kernel_weight(d2 * inverse_r2);
            }
        }
        // The kernel's factor is the same for all.
        add(q.indirect, indirect_leaf * (kernel_scale * inverse_r2));
        if (caustics) {
            add(q.caustic, caustic_leaf * (kernel_scale * inverse_caustic_r2));
        }
        q.coverage += area_leaf * (kernel_scale * inverse_r2);
    }
    // Photons fill only the part of the disc that lies on surfaces. It is known of the whole disc
    // only.
    real scale =
        params.boundary_correction != 0u ? real(1.0) / max(q.coverage, least_coverage) : real(1.0);
    store_query(q, scale, caustic_r2 < r2 ? real(1.0) : scale);
}
