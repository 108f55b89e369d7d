// How far the area samples in a disc tell how much of it lies on surfaces: wholly if `enough` are
// expected, and not at all if fewer than half as many. Where photons are that dense, edges matter
// little.
FN real trusted_share(real samples, real enough) {
    return clamp(samples * (real(2.0) / enough) - real(1.0), real(0.0), real(1.0));
}
