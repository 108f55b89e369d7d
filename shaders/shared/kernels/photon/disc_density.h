// Density estimation over the photons within a radius, with Epanechnikov's kernel or a uniform one.
// With `ball` all photons of a ball count, whatever their surface: Keller et al. 2010, section 1.
#include "shared/kernels/photon/disc_weight.h"

struct Bandwidth {
    real r2, inverse_r2;
    real caustic_r2, inverse_caustic_r2;
};

FN Bandwidth make_bandwidth() {
    Bandwidth b;
    b.r2 = params.radius * params.radius;
    b.caustic_r2 = params.caustic_radius * params.caustic_radius;
    b.inverse_r2 = real(1.0) / b.r2;
    b.inverse_caustic_r2 = real(1.0) / b.caustic_r2;
    return b;
}

FN real search_radius2(IN(Bandwidth) b) { return b.r2; }

FN bool may_reach(IN(Bandwidth) b, vec3 d) { return dot3(d, d) < b.r2; }

// Whether a photon of the ball comes from the side of the surface that the eye sees. BRDFs are 0
// for the others.
FN bool from_above(IN(Query) q, uvec4 carried) {
    return dot3(unpack_unit(carried.w), q.normal) > real(0.0);
}

FN void add_photon(IN(Bandwidth) b, uint j, INOUT(Query) q, INOUT(LeafSums) leaf) {
    uvec4 place = PHOTONS(2u * j);
    vec3 d = bits_float(uvec3(place)) - q.p;
    // Photons outside the ball do not count, even if their distance within the disc is less: which
    // of them are found depends on how the map is searched.
    if (may_reach(b, d) && (ball || on_same_surface(q, place.w, d))) {
        real height = ball ? real(0.0) : dot3(d, q.normal);
        real d2 = dot3(d, d) - height * height;
        uvec4 carried = PHOTONS(2u * j + 1u);
        if (ball && !from_above(q, carried)) {
            return;
        }
        if ((place.w & area_sample_bit) != 0u) {
            real area = open_area(q, carried) * disc_weight(d2 * b.inverse_r2);
            leaf.area += area;
            add_area(leaf.moments, area, d);
        } else if (is_caustic(place)) {
            leaf.caustic += scattered(q, carried).radiance * disc_weight(d2 * b.inverse_caustic_r2);
        } else {
            Scattered light = scattered(q, carried);
            vec3 flux = light.radiance * disc_weight(d2 * b.inverse_r2);
            leaf.indirect += flux;
            add_flux(leaf.moments, flux, light.weight, d, d2);
        }
    }
}

// All photons of a kind have the same factor of the kernel.
FN void add_leaf(IN(Bandwidth) b, IN(LeafSums) leaf, INOUT(Query) q) {
    add(q.indirect, leaf.indirect * (kernel_scale * b.inverse_r2));
    if (caustics) {
        add(q.caustic, leaf.caustic * (kernel_scale * b.inverse_caustic_r2));
    }
    q.coverage += leaf.area * (kernel_scale * b.inverse_r2);
    add_moments(q.moments, leaf.moments, kernel_scale * b.inverse_r2);
}

// Area samples tell the coverage of the larger disc only.
FN real caustic_scale(IN(Bandwidth) b, real scale) {
    return b.caustic_r2 < b.r2 ? real(1.0) : scale;
}
