// The share of a caustic's kernel that lies on surfaces, from the samples of an area tree. Kernels
// that include this define struct Spread, the kernel's shape around a point, and
// - real spread_weight(Spread, vec3 offset, vec3 normal): its value [1/area] at an area sample;
// and declare NODES of an area tree, PHOTONS and `places`.
#include "shared/kernels/photon/corrected.h"
#include "shared/kernels/photon/leaf_walk.h"
#include "shared/kernels/photon/same_surface.h"
#include "shared/kernels/photon/trusted_share.h"

// Where a spread has more area samples than this, only a part of them is looked at.
CONSTANT real most_samples = real(1024.0);

// A share for which this many samples stand is trusted, however small it is.
CONSTANT real enough_samples = real(8.0);
CONSTANT real longest_stride = real(65536.0);

// Nodes of the tree that are looked at. A spread over so many counts as covered.
CONSTANT uint most_nodes = 32768u;

// The point around which flux is spread, on one side of a surface.
struct Center {
    vec3 p, normal;
    uint own_normal, opposite_normal; // packed
    real rounding;                    // of heights over the tangent plane
};

FN Center make_center(vec3 p, vec3 normal) {
    Center c;
    c.p = p;
    c.normal = normal;
    c.own_normal = pack_photon_normal(normal, false);
    c.opposite_normal = pack_photon_normal(-normal, false);
    c.rounding = max_component(abs(p)) * position_rounding;
    return c;
}

// The part of the spread for which the area sample with this index in the map stands.
FN real covered_by(IN(Center) c, IN(Spread) spread, uint index) {
    uvec4 place = PHOTONS(2u * index);
    vec3 offset = bits_float(uvec3(place)) - c.p;
    vec3 normal = unpack_photon_normal(place.w);
    bool front = dot3(normal, c.normal) > real(0.0);
    if (!are_on_one_surface(c.normal, front ? c.own_normal : c.opposite_normal, place.w, !front,
                            c.rounding, offset)) {
        return real(0.0);
    }
    real weight = spread_weight(spread, offset, front ? normal : -normal);
    if (!(weight > real(0.0))) {
        return real(0.0);
    }
    uvec4 carried = PHOTONS(2u * index + 1u);
    return weight * bits_float(front ? carried.x : carried.y);
}

// By how much to multiply flux that is spread around a point within a distance, so that it all
// arrives. area: of the spread [length²]. phase: any number; which samples to look at.
FN real covered_scale(IN(Center) c, IN(Spread) spread, real reach2, real area, uint phase) {
    real samples = params.samples_per_area * area;
    real trust = trusted_share(samples);
    if (!(trust > real(0.0)) || !is_in_corrected_part(c.p)) {
        return real(1.0);
    }
    uint stride = uint(clamp(samples / most_samples, real(1.0), longest_stride));
    real covered = real(0.0);
    uint steps = 0u;
    uint node = params.samples > area_block ? 0u : 1u;
    while (node != lbvh_end && steps < most_nodes) {
        PhotonRange block = next_leaf(c.p, reach2, most_nodes, node, steps);
        uint first = block.first * area_block;
        uint end = min(block.end * area_block, params.samples);
        for (uint k = first + (phase - first) % stride; k < end; k += stride) {
            covered += covered_by(c, spread, places[k]);
        }
    }
    real least = min(least_divisor, enough_samples * real(stride) / samples);
    real known = node == lbvh_end ? covered * real(stride) : real(1.0);
    return real(1.0) / mix(real(1.0), max(known, least), trust);
}
