#include "shared/kernels/accel/finite_triangle.h"

// Computes the bounding box of each triangle.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count.number) {
        return;
    }
    Corners t = finite_triangle(triangles[i]);
    boxes[2u * i] = vec4(min(min(t.a, t.b), t.c), real(0.0));
    boxes[2u * i + 1u] = vec4(max(max(t.a, t.b), t.c), real(0.0));
}
