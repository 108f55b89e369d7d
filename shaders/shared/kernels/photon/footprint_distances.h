// The distance from each point to its n-th nearest footprint, in units of the footprint: the factor
// by which footprints have to grow so that n of them contain the point.
struct Candidates {
    vec3 point;
    uint footprints;
};

FN uint candidate_count(IN(Candidates) c) { return c.footprints; }

FN real candidate_distance(IN(Candidates) c, uint i) {
    uint place = i * params.stride;
    FootprintDuals duals = unpack_duals(footprints[place]);
    vec3 offset = c.point - vec3(photons[place].x, photons[place].y, photons[place].z);
    real x = dot3(duals.a, offset);
    real y = dot3(duals.b, offset);
    // Heights are in units of the square root of the ellipse's area.
    real inverse_area;
    vec3 normal = unit_and_length(cross3(duals.a, duals.b), inverse_area);
    real height = dot3(normal, offset) / disc_half_height;
    return sqrt(x * x + y * y + height * height * inverse_area);
}

#include "shared/kernels/photon/nth_smallest.h"

FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.points) {
        return;
    }
    Candidates c;
    c.point = vec3(points[i]);
    c.footprints = params.footprints;
    distances[i] = nth_smallest(c, params.rank);
}
