// The share of a caustic's kernel that lies on surfaces, from the samples of an area tree. Kernels
// that include this define struct Spread, the kernel's shape around a point, and
// - real spread_weight(Spread, vec3 offset, vec3 normal): its value [1/area] at an area sample;
// and declare CoverParams params, NODES of an area tree, PHOTONS and `places`.
#include "shared/kernels/photon/corrected.h"
#include "shared/kernels/photon/leaf_walk.h"
#include "shared/kernels/photon/same_surface.h"
#include "shared/kernels/photon/trusted_share.h"

// Area samples in a spread from which on they tell its covered share.
CONSTANT real trusted_samples = real(2.0) * least_cover_samples;

// Where a spread has more area samples than this, only a part of them is looked at.
CONSTANT real most_samples = real(1024.0);
CONSTANT real longest_stride = real(65536.0);

// A share for which this many samples stand is trusted, however small it is.
CONSTANT real enough_samples = real(8.0);

// Nodes and samples that are looked at. A spread over more counts as covered.
CONSTANT uint most_steps = 16384u;

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

// The part of the spread for which the area sample with this index in the map stands. Caustic
// photons stay where other light is taken from covered places, so the whole area counts.
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
    return weight * bits_float(PHOTONS(2u * index + 1u).z);
}

// By how much to multiply flux that is spread around a point, so that it all arrives. reach2:
// squared distance of the farthest point that it may reach; area: of the spread's support
// [length²]; phase: any number, which decides what samples are looked at if there are many.
FN real covered_scale(IN(Center) c, IN(Spread) spread, real reach2, real area, uint phase) {
    real samples = params.samples_per_area * area;
    real trust = trusted_share(samples, trusted_samples);
    if (!(trust > real(0.0)) || !is_in_corrected_part(c.p, sqrt(reach2))) {
        return real(1.0);
    }
    uint stride = uint(clamp(samples / most_samples, real(1.0), longest_stride));
    real covered = real(0.0);
    uint steps = 0u;
    uint node = params.samples > area_block ? 0u : 1u;
    while (node != lbvh_end && steps < most_steps) {
        PhotonRange block = next_leaf(c.p, reach2, most_steps, node, steps);
        uint first = block.first * area_block;
        uint end = min(block.end * area_block, params.samples);
        for (uint k = first + (phase - first) % stride; k < end; k += stride) {
            covered += covered_by(c, spread, places[k]);
            ++steps;
        }
    }
    if (node != lbvh_end || !(covered > real(0.0))) {
        return real(1.0);
    }
    real least = min(least_divisor, enough_samples * real(stride) / samples);
    return real(1.0) / mix(real(1.0), max(covered * real(stride), least), trust);
}
