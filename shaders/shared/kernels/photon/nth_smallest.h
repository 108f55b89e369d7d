// Selection by radix: from the highest bits down, each round counts the candidates by the next bits
// of their distances. The kernel defines the struct Candidates, its candidate_count(), and the
// distance of each candidate, which is not negative.
CONSTANT uint digit_bits = 8u;
CONSTANT uint digits = 256u;
CONSTANT uint lowest_shift = 15u; // leaves a relative error of 2^-9

// The n-th smallest distance, n from 1; the largest if there are fewer candidates.
FN real nth_smallest(IN(Candidates) c, uint n) {
    uint count = candidate_count(c);
    uint rank = min(n, count);
    uint found = 0u; // the bits known so far, in their places
    uint counts[digits];
    for (uint shift = 23u; shift >= lowest_shift; shift -= digit_bits) {
        for (uint digit = 0u; digit < digits; ++digit) {
            counts[digit] = 0u;
        }
        for (uint i = 0u; i < count; ++i) {
            uint bits = float_bits(candidate_distance(c, i));
            if (bits >> (shift + digit_bits) == found >> (shift + digit_bits)) {
                uint digit = (bits >> shift) & (digits - 1u);
                counts[digit] += 1u;
            }
        }
        uint digit = 0u;
        while (digit + 1u < digits && rank > counts[digit]) {
            rank -= counts[digit];
            digit += 1u;
        }
        found |= digit << shift;
    }
    return bits_float(found | (1u << (lowest_shift - 1u)));
}
