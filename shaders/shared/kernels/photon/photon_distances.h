// The distance from each point to its n-th nearest photon, among photons that are near the point in
// the order of codes. Neighbours on a surface are near in this order, but on both sides and with
// gaps.
struct Candidates {
    vec3 point;
    uint first_other, others;
    uint first_caustic, caustics;
};

FN uint candidate_count(IN(Candidates) c) { return c.others + c.caustics; }

FN vec3 photon_position(uint i) { return vec3(photons[i].x, photons[i].y, photons[i].z); }

FN real candidate_distance(IN(Candidates) c, uint i) {
    uint place = i < c.others ? c.first_other + i * params.stride
                              : c.first_caustic + (i - c.others) * params.stride;
    real distance;
    unit_and_length(photon_position(place) - c.point, distance);
    return distance;
}

#include "shared/kernels/photon/nth_smallest.h"

// The first photon from `begin` to `end` whose code is `code` or more.
FN uint place_of(uint code, uint begin, uint end) {
    while (begin < end) {
        uint middle = begin + (end - begin) / 2u;
        if (codes[middle] < code) {
            begin = middle + 1u;
        } else {
            end = middle;
        }
    }
    return begin;
}

// Sets the photons from `begin` to `end` that are looked at.
FN void choose_near(uint place, uint begin, uint end, OUT(uint) first, OUT(uint) number) {
    first = place - min(place - begin, params.reach);
    uint last = place + min(end - place, params.reach + 1u);
    number = (last - first + params.stride - 1u) / params.stride;
}

FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.points) {
        return;
    }
    bool caustic = params.caustic_step > 0u;
    Candidates c;
    c.point = caustic ? photon_position(params.others + i * params.caustic_step) : vec3(points[i]);
    vec3 low = vec3(bounds[0]);
    vec3 high = low + vec3(max_component(vec3(bounds[1]) - low));
    uint code = morton30(c.point, low, high) << 1u;
    c.first_other = c.others = 0u;
    if (!caustic) {
        choose_near(place_of(code, 0u, params.others), 0u, params.others, c.first_other, c.others);
    }
    uint end = params.others + params.caustics;
    choose_near(place_of(code | photon_kind_bit, params.others, end), params.others, end,
                c.first_caustic, c.caustics);
    distances[i] = nth_smallest(c, params.rank);
}
