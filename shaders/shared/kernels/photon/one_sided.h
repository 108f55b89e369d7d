// Estimates whose light comes from one side of the disc. Where a wall stands on a floor, the
// floor's photons behind the wall lie on the same surface and within the disc, but in the light of
// another room. Then the flux's centroid lies far from the query, and behind the wall.

// Sums over the photons of a query, of a few or of all.
struct Moments {
    vec3 offset; // weighted flux, summed over the channels, times the offset from the query
    real square; // the same flux times the squared length of the offset
};

FN Moments no_moments() { return Moments(vec3(real(0.0)), real(0.0)); }

FN Moments moments_of(IN(GatherRecord) g) {
    return Moments(vec3(g.moment_x, g.moment_y, g.moment_z), g.square);
}

FN real sum_of_channels(vec3 flux) { return flux.x + flux.y + flux.z; }

// squared: the squared length of the offset, or of its part along the query's plane.
FN void add_flux(INOUT(Moments) moments, vec3 flux, vec3 offset, real squared) {
    real sum = sum_of_channels(flux);
    moments.offset += sum * offset;
    moments.square += sum * squared;
}

FN void add_moments(INOUT(Moments) sum, IN(Moments) term, real scale) {
    sum.offset += scale * term.offset;
    sum.square += scale * term.square;
}

// The offset of the flux's centroid, if it is larger than light that varies linearly over the disc
// can bring about; else 0. flux: the sum without offsets. Divides first: the square of a flux may
// be out of range.
FN vec3 one_sided_offset(IN(Moments) moments, vec3 flux) {
    real sum = sum_of_channels(flux);
    if (!(sum > real(0.0))) {
        return vec3(real(0.0));
    }
    vec3 offset = moments.offset / sum;
    bool one_sided = dot3(offset, offset) > most_one_sided * (moments.square / sum);
    return one_sided ? offset : vec3(real(0.0));
}
