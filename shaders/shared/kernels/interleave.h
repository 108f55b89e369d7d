// CPU devices give each core one contiguous half of a dispatch. Taking blocks of pixels alternately
// from both halves of the image keeps both cores busy to the end.
FN uint interleave(uint i, uint count) {
    const uint block = 64u;
    uint blocks = count / block;
    if (i >= blocks * block) {
        return i;
    }
    uint half_of_them = (blocks + 1u) / 2u;
    uint b = i / block;
    uint from = b < half_of_them ? 2u * b : 2u * (b - half_of_them) + 1u;
    return from * block + i % block;
}
