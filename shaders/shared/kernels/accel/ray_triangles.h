#include "shared/kernels/accel/finite_triangle.h"

// Copies the triangles' vertices into the order of the leaves.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count.number) {
        return;
    }
    uint triangle = order[i];
    Corners t = finite_triangle(triangles[triangle]);
    leaf_triangles[3u * i] = vec4(t.a, bits_float(triangle));
    leaf_triangles[3u * i + 1u] = vec4(t.b, real(0.0));
    leaf_triangles[3u * i + 2u] = vec4(t.c, real(0.0));
}
