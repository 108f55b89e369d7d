// Density estimation over the footprints that reach a query: Fabianowski and Dingliana 2009, eq. 1
// and section 6.3.
#include "shared/kernels/photon/query_state.h"

FN void main() {
    Query q;
    if (!load_query(q)) {
        return;
    }
    uint steps = 0u;
    for (;;) {
        // Boxes are around whole footprints: those that hold the point.
        PhotonRange range = next_leaf(q.p, real(0.0), params.budget, q.node, steps);
        if (range.end == 0u) {
            break;
        }
        vec3 indirect_leaf = vec3(real(0.0));
        vec3 caustic_leaf = vec3(real(0.0));
        steps += range.end - range.first;
        for (uint j = range.first; j < range.end; ++j) {
            uvec4 place = PHOTONS(2u * j);
            uvec4 packed = FOOTPRINTS(j);
            vec3 offset = q.p - bits_float(uvec3(place));
            FootprintDuals duals;
            duals.a = unpack_dual(packed.x, packed.y);
            duals.b = unpack_dual(packed.z, packed.w);
            real x = dot3(duals.a, offset);
            real y = dot3(duals.b, offset);
            if (x * x + y * y > real(1.0) || !on_same_side(q, place.w)) {
                continue;
            }
            vec3 normal = unpack_photon_normal(place.w);
            real weight =
                footprint_weight(duals, normal, q.normal, offset, params.flatness, uniform_kernel);
            if (!(weight > real(0.0))) {
                continue;
            }
            uvec4 carried = PHOTONS(2u * j + 1u);
            if ((place.w & area_sample_bit) != 0u) {
                q.coverage += bits_float(carried.x) * weight;
            } else if (is_caustic(place)) {
                caustic_leaf += scattered(q, carried) * weight;
            } else {
                indirect_leaf += scattered(q, carried) * weight;
            }
        }
        add(q.indirect, indirect_leaf);
        if (caustics) {
            add(q.caustic, caustic_leaf);
        }
    }
    // The footprints of area samples are those of the diffusely scattered photons around them.
    store_query(q,
                params.boundary_correction != 0u ? real(1.0) / max(q.coverage, least_coverage)
                                                 : real(1.0),
                real(1.0));
}
