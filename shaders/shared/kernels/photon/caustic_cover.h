// Caustic footprints at edges. The part of a footprint that lies beside its surface is lost, so the
// rest gets its flux: the photon's is divided by the share that lies on the surface, which the area
// samples tell. Other light is divided at each query instead, by its area samples' footprints,
// which have the size of the photons around them. That of caustics has sizes of its own.

struct Spread {
    FootprintDuals duals;
    vec3 normal;
};

FN real spread_weight(IN(Spread) spread, vec3 offset, vec3 normal) {
    return footprint_weight(spread.duals, spread.normal, normal, offset, params.flatness,
                            uniform_kernel);
}

#include "shared/kernels/photon/covered_share.h"

FN void main() {
    if (THREAD_INDEX >= counters[counter_wide_caustics]) {
        return;
    }
    uint i = wide_caustics[THREAD_INDEX];
    uvec4 place = PHOTONS(2u * i);
    vec3 normal = unpack_photon_normal(place.w);
    FootprintDuals duals = unpack_duals(footprints[i]);
    Footprint f = footprint_of_duals(duals, normal, params.flatness);
    make_principal(f.u, f.v);
    Spread spread;
    spread.duals = duals;
    spread.normal = normal;
    real scale = covered_scale(make_center(bits_float(uvec3(place)), normal), spread,
                               dot3(f.u, f.u), footprint_area(f), i);
    uvec4 carried = PHOTONS(2u * i + 1u);
    photons[2u * i + 1u] = uvec4(float_bits(scale * bits_float(uvec3(carried))), carried.w);
}
