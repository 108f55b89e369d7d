#include "shared/kernels/world/area_piece.h"

FN real distance3(vec3 a, vec3 b) { return sqrt(dot3(a - b, a - b)); }

// Into how many pieces a piece is divided: 4 if it reaches beyond the sampled part and is not small
// in comparison with it, 0 if it lies outside or has no area, else 1.
FN uint pieces_of(uvec2 piece) {
    if (!(areas[piece.x].x > real(0.0))) {
        return 0u;
    }
    PieceCorners corners = corners_of(piece);
    vec3 middle = middle_of(corners);
    real radius = max(max(distance3(middle, corners.a), distance3(middle, corners.b)),
                      distance3(middle, corners.c));
    real to_center = distance3(middle, vec3(params.center_x, params.center_y, params.center_z));
    if (to_center - radius > params.reach) {
        return 0u;
    }
    bool crosses = to_center + radius > params.reach && real(8.0) * radius > params.reach;
    return crosses && piece.y < smallest_piece ? 4u : 1u;
}

FN void main() {
    uint i = THREAD_INDEX;
    if (i > params.count) {
        return;
    }
    if (i == params.count) {
        counts[i] = 0u; // whose place is the sum of all others
        return;
    }
    counts[i] = pieces_of(params.of_triangles != 0u ? uvec2(i, whole_triangle) : pieces[i]);
}
