// The answer to a query: its estimate, from the sums over photons.
#include "shared/kernels/photon/corrected.h"

// Whether the area samples around a query at p tell how much of its disc lies on surfaces.
FN bool is_corrected(IN(vec3) p) {
    return params.boundary_correction != 0u && is_in_corrected_part(p);
}

// Photons cover only the part of the kernel's support that lies on surfaces. The area samples give
// that part once all of them have been seen.
FN real known_coverage(IN(vec3) p, real coverage) { return is_corrected(p) ? coverage : real(1.0); }

// unevenness() around a query at p; 0 where it is not known.
FN real known_unevenness(IN(vec3) p, IN(Moments) moments, vec3 flux, real area) {
    return is_corrected(p) ? unevenness(moments, flux, area) : real(0.0);
}

FN real answer_scale(real coverage) { return real(1.0) / max(coverage, least_divisor); }

// coverage: known_coverage() of the query's disc; uneven: known_unevenness().
FN void store_estimate(uint slot, IN(vec3) indirect, IN(vec3) caustic, real coverage, real uneven) {
    estimates[slot] = EstimateRecord(indirect.x, indirect.y, indirect.z, coverage, caustic.x,
                                     caustic.y, caustic.z, uneven);
}
