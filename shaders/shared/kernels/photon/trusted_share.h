// How far the area samples in a disc tell how much of it lies on surfaces, given how many are
// expected: not at all if fewer than half of trusted_samples. Where photons are that dense, edges
// matter little.
FN real trusted_share(real samples) {
    return clamp(samples * (real(2.0) / trusted_samples) - real(1.0), real(0.0), real(1.0));
}
