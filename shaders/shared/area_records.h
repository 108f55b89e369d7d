// Records of the kernels that make the table of areas (engine/world/area_table.hpp).
#ifndef ARGAND_SHARED_AREA_RECORDS_H
#define ARGAND_SHARED_AREA_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// What the host learns about the pieces: indices into an array of uint.
CONSTANT uint area_state_most = 0u;    // parts into which any piece is divided
CONSTANT uint area_state_pieces = 1u;  // number after the division
CONSTANT uint area_state_largest = 2u; // bits of the largest piece's area
CONSTANT uint area_state_sum = 3u;     // of all areas in units: the low word, then the high word
CONSTANT uint area_state_count = 5u;

// Areas are summed in units of 2^-scale: `largest` has the bits of the largest one, and there are
// at most 2^headroom_bits. Their sum is below 2^63 units, and the largest area takes at least
// 62 - headroom_bits bits.
FN int area_scale(uint largest, uint headroom_bits) {
    return 189 - int(headroom_bits) - int(max(largest >> 23u, 1u));
}

struct AreaTriangleParams {
    uint count; // of triangles
};

struct AreaPieceParams {
    uint count;        // of pieces
    uint of_triangles; // whether they are all triangles, whole; else `pieces` lists them
    float32 reach;     // pieces lie within this distance of the center
    float32 center_x, center_y, center_z;
};

struct AreaCodeParams {
    uint count;                  // of pieces
    float32 low_x, low_y, low_z; // box of the scene
    float32 high_x, high_y, high_z;
};

struct AreaSumParams {
    uint count;         // of pieces
    uint headroom_bits; // count <= 2^headroom_bits
};

ARGAND_SHARED_END

#endif
