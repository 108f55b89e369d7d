// Caustic discs at edges. The area samples that a query meets tell how much of the disc of its
// other light lies on surfaces; the disc of caustics has a size of its own.

#include "shared/kernels/photon/disc_weight.h"

struct Spread {
    real squared_radius;
    real stretch; // a photon's squared distance: |d|² + stretch (d · n)²
    vec3 normal;
};

FN real spread_weight(IN(Spread) spread, vec3 offset, vec3) {
    real height = dot3(offset, spread.normal);
    real squared_distance = dot3(offset, offset) + spread.stretch * height * height;
    return disc_weight(squared_distance / spread.squared_radius) * kernel_scale /
           spread.squared_radius;
}

#include "shared/kernels/photon/covered_share.h"

FN void main() {
    uint k = THREAD_INDEX;
    if (k >= counts[params.count_index]) {
        return;
    }
    uint slot = active_slots[k];
    EstimateRecord found = estimates[slot];
    // Discs of their own are those of the nearest photons.
    bool own = !(params.squared_radius > real(0.0));
    real squared_radius = own ? squared_radii[slot] : params.squared_radius;
    if (!(found.caustic_r + found.caustic_g + found.caustic_b > real(0.0)) ||
        !(squared_radius > real(0.0))) {
        return;
    }
    QueryRecord query = queries[slot];
    Center center =
        make_center(vec3(query.x, query.y, query.z), unpack_unit(query.geometric_normal));
    Spread spread;
    spread.squared_radius = squared_radius;
    spread.stretch = own ? nearest_stretch : -real(1.0);
    spread.normal = center.normal;
    // What lies within the disc is no farther than this on the query's surface.
    real reach2 = squared_radius / (real(1.0) - steepest_chord);
    real scale = covered_scale(center, spread, reach2, PI * squared_radius, slot);
    found.caustic_r *= scale;
    found.caustic_g *= scale;
    found.caustic_b *= scale;
    estimates[slot] = found;
}
