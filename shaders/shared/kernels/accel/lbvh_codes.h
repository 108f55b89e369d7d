#include "shared/kernels/count.h"

// Computes the 30-bit Morton code of each box's centre within the bounds of all boxes.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= ELEMENT_COUNT) {
        return;
    }
    vec3 centre = real(0.5) * vec3(boxes[2u * i]) + real(0.5) * vec3(boxes[2u * i + 1u]);
    codes[i] = morton30(centre, vec3(bounds[0]), vec3(bounds[1]));
    order[i] = i;
}
