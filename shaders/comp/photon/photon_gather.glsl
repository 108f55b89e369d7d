// Density estimation within a radius. Included by kernels that define TEXELS (0 or 1).
#include "photon/query_state.glsl"

void main() {
    Query q;
    if (!load_query(q)) {
        return;
    }
    float r2 = params.radius * params.radius;
    float caustic_r2 = params.caustic_radius * params.caustic_radius;
    float inverse_r2 = 1.0 / r2;
    float inverse_caustic_r2 = 1.0 / caustic_r2;
    float half_height = params.radius * disc_half_height;

    uint steps = 0u;
    for (;;) {
        PhotonRange range = next_leaf(q.p, r2, params.budget, q.node, steps);
        if (range.end == 0u) {
            break;
        }
        vec3 indirect_leaf = vec3(0.0);
        vec3 caustic_leaf = vec3(0.0);
        float area_leaf = 0.0;
        steps += range.end - range.first;
        for (uint j = range.first; j < range.end; ++j) {
            uvec4 place = PHOTONS(2u * j);
            vec3 d = uintBitsToFloat(place.xyz) - q.p;
            float height = dot3(d, q.normal);
            float d2 = dot3(d, d) - height * height;
            if (!(d2 < r2) || abs(height) > half_height || !on_same_side(q, place.w)) {
                continue;
            }
            uvec4 carried = PHOTONS(2u * j + 1u);
            if ((place.w & area_sample_bit) != 0u) {
                area_leaf += uintBitsToFloat(carried.x) * kernel_weight(d2 * inverse_r2);
            } else if (photon_is_caustic(place.w)) {
                caustic_leaf += scattered(q, carried) * kernel_weight(d2 * inverse_caustic_r2);
            } else {
                indirect_leaf += scattered(q, carried) * kernel_weight(d2 * inverse_r2);
            }
        }
        // The kernel's factor is the same for all.
        add(q.indirect, indirect_leaf * (kernel_scale * inverse_r2));
        add(q.caustic, caustic_leaf * (kernel_scale * inverse_caustic_r2));
        q.coverage += area_leaf * (kernel_scale * inverse_r2);
    }
    // Photons fill only the part of the disc that lies on surfaces. It is known of the whole disc only.
    float scale = params.boundary_correction != 0u ? 1.0 / max(q.coverage, least_coverage) : 1.0;
    store_query(q, scale, caustic_r2 < r2 ? 1.0 : scale);
}
