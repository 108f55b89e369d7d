#include "shared/kernels/count.h"

FN uvec2 code(uint i) {
    return codes64 ? uvec2(codes[2u * i], codes[2u * i + 1u]) : uvec2(0u, codes[i]);
}

// Distance of each sorted code from the next one.
FN void main() {
    uint i = THREAD_INDEX;
    uint count = ELEMENT_COUNT;
    if (i < count) {
        distances[i] =
            i + 1u < count ? code_distance(code(i), i, code(i + 1u), i + 1u) : no_neighbour;
    }
}
