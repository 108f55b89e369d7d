// The film's sums of one pixel, with their rounding errors.
struct FilmSums {
    vec3 direct, indirect, caustic;
    vec3 lost_direct, lost_indirect, lost_caustic;
};

FN FilmSums film_sums(IN(FilmRecord) f) {
    FilmSums s;
    s.direct = vec3(f.direct_r, f.direct_g, f.direct_b);
    s.indirect = vec3(f.indirect_r, f.indirect_g, f.indirect_b);
    s.caustic = vec3(f.caustic_r, f.caustic_g, f.caustic_b);
    s.lost_direct = vec3(f.lost_direct_r, f.lost_direct_g, f.lost_direct_b);
    s.lost_indirect = vec3(f.lost_indirect_r, f.lost_indirect_g, f.lost_indirect_b);
    s.lost_caustic = vec3(f.lost_caustic_r, f.lost_caustic_g, f.lost_caustic_b);
    return s;
}

// The record of these sums, with the numbers of samples of `f`.
FN FilmRecord film_record(IN(FilmSums) s, IN(FilmRecord) f) {
    return FilmRecord(s.direct.x, s.direct.y, s.direct.z, f.samples, s.indirect.x, s.indirect.y,
                      s.indirect.z, f.samples_high, s.caustic.x, s.caustic.y, s.caustic.z,
                      f.non_finite, s.lost_direct.x, s.lost_direct.y, s.lost_direct.z,
                      f.non_finite_high, s.lost_indirect.x, s.lost_indirect.y, s.lost_indirect.z,
                      real(0.0), s.lost_caustic.x, s.lost_caustic.y, s.lost_caustic.z, real(0.0));
}
