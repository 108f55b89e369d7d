// Density estimation over the footprints that reach a query: Fabianowski and Dingliana 2009, eq. 1 and section 6.3.
// Included by kernels that define TEXELS (0 or 1).
#include "photon/query_state.glsl"
#include "shared/footprint.h"

#if TEXELS
layout(set = 0, binding = 10) uniform utextureBuffer footprints;
#define FOOTPRINTS(i) texelFetch(footprints, int(i))
#else
layout(set = 0, binding = 10) readonly buffer Footprints { uvec4 footprints[]; };
#define FOOTPRINTS(i) footprints[i]
#endif

layout(constant_id = 1) const bool uniform_kernel = false;

void main() {
    Query q;
    if (!load_query(q)) {
        return;
    }
    uint steps = 0u;
    for (;;) {
        // Boxes are around whole footprints: those that hold the point.
        PhotonRange range = next_leaf(q.p, 0.0, params.budget, q.node, steps);
        if (range.end == 0u) {
            break;
        }
        vec3 indirect_leaf = vec3(0.0);
        vec3 caustic_leaf = vec3(0.0);
        steps += range.end - range.first;
        for (uint j = range.first; j < range.end; ++j) {
            uvec4 place = PHOTONS(2u * j);
            uvec4 packed = FOOTPRINTS(j);
            vec3 offset = q.p - uintBitsToFloat(place.xyz);
            FootprintDuals duals;
            duals.a = unpack_dual(packed.x, packed.y);
            duals.b = unpack_dual(packed.z, packed.w);
            float x = dot3(duals.a, offset);
            float y = dot3(duals.b, offset);
            if (x * x + y * y > 1.0 || !on_same_side(q, place.w)) {
                continue;
            }
            vec3 normal = unpack_photon_normal(place.w);
            float weight = footprint_weight(duals, normal, q.normal, offset, params.flatness, uniform_kernel);
            if (!(weight > 0.0)) {
                continue;
            }
            uvec4 carried = PHOTONS(2u * j + 1u);
            if ((place.w & area_sample_bit) != 0u) {
                q.coverage += uintBitsToFloat(carried.x) * weight;
            } else if (photon_is_caustic(place.w)) {
                caustic_leaf += scattered(q, carried) * weight;
            } else {
                indirect_leaf += scattered(q, carried) * weight;
            }
        }
        add(q.indirect, indirect_leaf);
        add(q.caustic, caustic_leaf);
    }
    // The footprints of area samples are those of the diffusely scattered photons around them.
    store_query(q, params.boundary_correction != 0u ? 1.0 / max(q.coverage, least_coverage) : 1.0, 1.0);
}
