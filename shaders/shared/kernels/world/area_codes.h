#include "shared/kernels/world/area_piece.h"

// Finds a piece's place along the space-filling curve, and its area, whose bits increase with it.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    uvec2 piece = pieces[i];
    codes[i] =
        morton30(middle_of(corners_of(piece)), vec3(params.low_x, params.low_y, params.low_z),
                 vec3(params.high_x, params.high_y, params.high_z));
    order[i] = i;
    area_bits[i] = float_bits(scale_by_power(areas[piece.x].x, -2 * int(divisions_of(piece.y))));
}
