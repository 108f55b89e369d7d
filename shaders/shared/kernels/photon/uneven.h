// Estimates whose light is too uneven over the disc: at the foot of a body or under it, in a
// crevice, or before a wall that stands on a floor, behind which the floor goes on in the light of
// another room. There the flux gathers on one side, more than the surface does.

// Sums over the photons and area samples of a query, of a few or of all. A photon's flux is summed
// over the channels; flux and area have the weights of the kernel.
struct Moments {
    vec3 flux_offset;           // flux times the offset from the query
    real square;                // flux times the squared length of the offset
    vec3 area_offset;           // area times the offset
    real weight, weight_square; // sums of Scattered::weight and of its square
};

FN Moments no_moments() {
    return Moments(vec3(real(0.0)), real(0.0), vec3(real(0.0)), real(0.0), real(0.0));
}

FN Moments moments_of(IN(GatherRecord) g) {
    return Moments(vec3(g.flux_offset_x, g.flux_offset_y, g.flux_offset_z), g.square,
                   vec3(g.area_offset_x, g.area_offset_y, g.area_offset_z), g.weight,
                   g.weight_square);
}

FN real sum_of_channels(vec3 flux) { return flux.x + flux.y + flux.z; }

// squared: the squared length of the offset, or of its part along the query's plane.
FN void add_flux(INOUT(Moments) moments, vec3 flux, real weight, vec3 offset, real squared) {
    real sum = sum_of_channels(flux);
    moments.flux_offset += sum * offset;
    moments.square += sum * squared;
    moments.weight += weight;
    moments.weight_square += weight * weight;
}

FN void add_area(INOUT(Moments) moments, real area, vec3 offset) {
    moments.area_offset += area * offset;
}

// scale: of the weights.
FN void add_moments(INOUT(Moments) sum, IN(Moments) term, real scale) {
    sum.flux_offset += scale * term.flux_offset;
    sum.square += scale * term.square;
    sum.area_offset += scale * term.area_offset;
    sum.weight += term.weight;
    sum.weight_square += term.weight_square;
}

// How uneven the light is: the square of the offset from the area's centroid to that of the flux,
// over the mean of the squared offsets of the flux. Light that grows linearly over a whole disc,
// from 0 at its rim, has 1/12 with Epanechnikov's kernel and 1/8 with a uniform one. Four times the
// mean that photons of equal flux have by chance is taken off: an estimate that is left out because
// of its photons' noise has more light than the others, so what remains would be too dark. Where a
// glossy lobe scatters different shares of them, or some are bright because others were aimed, they
// count as the number of equally weighted photons that would have the same noise (Kish 1965,
// "Survey Sampling"). A photon that is much brighter than the others for another reason makes the
// light uneven: it may come from another room. flux, area: the sums without offsets; without area
// nothing is known.
FN real unevenness(IN(Moments) moments, vec3 flux, real area) {
    real sum = sum_of_channels(flux);
    // Squares of tiny weights have no digits left.
    if (!(sum > real(0.0)) || !(area > real(0.0)) || !(moments.weight_square > real(1e-37))) {
        return real(0.0);
    }
    vec3 between = moments.flux_offset / sum - moments.area_offset / area;
    real spread = moments.square / sum;
    real effective = moments.weight * (moments.weight / moments.weight_square);
    real chance = real(4.0) / effective;
    return spread > real(0.0) ? max(dot3(between, between) / spread - chance, real(0.0))
                              : real(0.0);
}
