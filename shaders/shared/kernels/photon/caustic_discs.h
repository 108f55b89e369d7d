// Caustic discs at edges. The area samples that a query meets tell how much of the disc of its
// other light lies on surfaces; the disc of caustics has a size of its own.

struct Spread {
    real squared_radius;
    vec3 normal;
};

FN real spread_weight(IN(Spread) spread, vec3 offset, vec3) {
    real height = dot3(offset, spread.normal);
    real u2 = (dot3(offset, offset) - height * height) / spread.squared_radius;
    real weight = !uniform_kernel ? kernel_weight(u2) : u2 < real(1.0) ? real(0.5) : real(0.0);
    return weight * kernel_scale / spread.squared_radius;
}

#include "shared/kernels/photon/covered_share.h"

FN void main() {
    uint k = THREAD_INDEX;
    if (k >= counts[params.count_index]) {
        return;
    }
    uint slot = active_slots[k];
    EstimateRecord found = estimates[slot];
    real squared_radius =
        params.squared_radius > real(0.0) ? params.squared_radius : squared_radii[slot];
    if (!(found.caustic_r + found.caustic_g + found.caustic_b > real(0.0)) ||
        !(squared_radius > real(0.0))) {
        return;
    }
    QueryRecord query = queries[slot];
    Center center =
        make_center(vec3(query.x, query.y, query.z), unpack_unit(query.geometric_normal));
    real scale = covered_scale(center, Spread(squared_radius, center.normal), squared_radius,
                               PI * squared_radius, slot);
    found.caustic_r *= scale;
    found.caustic_g *= scale;
    found.caustic_b *= scale;
    estimates[slot] = found;
}
