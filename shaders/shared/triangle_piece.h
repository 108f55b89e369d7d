// Pieces of a triangle, by repeated division into four at the middles of its edges. The number of
// a piece is 1 for the whole triangle, and 4 n + k for part k of piece n.
#ifndef ARGAND_SHARED_TRIANGLE_PIECE_H
#define ARGAND_SHARED_TRIANGLE_PIECE_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

CONSTANT uint whole_triangle = 1u;
CONSTANT uint smallest_piece = 1u << 28u; // pieces from here on are not divided

// Barycentric coordinates (of the second and the third vertex) of a piece's corners.
struct TrianglePiece {
    vec2 a, b, c;
};

FN TrianglePiece part_of_piece(IN(TrianglePiece) p, uint k) {
    vec2 ab = real(0.5) * (p.a + p.b);
    vec2 bc = real(0.5) * (p.b + p.c);
    vec2 ca = real(0.5) * (p.c + p.a);
    TrianglePiece part;
    part.a = k == 0u ? p.a : k == 1u ? ab : k == 2u ? ca : ab;
    part.b = k == 0u ? ab : k == 1u ? p.b : bc;
    part.c = k == 0u ? ca : k == 1u ? bc : k == 2u ? p.c : ca;
    return part;
}

// How often the triangle was divided, each time into four, until it came to this piece.
FN uint divisions_of(uint number) { return uint(findMSB(number)) / 2u; }

FN TrianglePiece triangle_piece(uint number) {
    TrianglePiece p;
    p.a = vec2(real(0.0), real(0.0));
    p.b = vec2(real(1.0), real(0.0));
    p.c = vec2(real(0.0), real(1.0));
    uint shift = 30u;
    while ((number >> shift) == 0u) {
        shift -= 2u;
    }
    while (shift > 0u) {
        shift -= 2u;
        p = part_of_piece(p, (number >> shift) & 3u);
    }
    return p;
}

ARGAND_SHARED_END

#endif
