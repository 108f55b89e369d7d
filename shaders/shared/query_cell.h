// Cells of space in which queries share one answer of the photon map (Binder, Fricke, Keller 2018,
// "Fast Path Space Filtering by Jittered Spatial Hashing").
#ifndef ARGAND_SHARED_QUERY_CELL_H
#define ARGAND_SHARED_QUERY_CELL_H

#include "shared/frame.h"
#include "shared/random.h"

ARGAND_SHARED_BEGIN

// Steps on either side of 0 in which a cell's normal is quantised on the octahedron. Each axis is
// in the middle of a step.
CONSTANT real cell_normal_steps = real(7.0);
// Height of a cell over its edge. It is small because density estimation counts photons only within
// a small share of the radius off the tangent plane.
CONSTANT real cell_height = real(0.25);
CONSTANT real largest_cell_index = real(1073741824.0);

FN uint cell_index(real x) {
    return uint(int(floor(clamp(x, -largest_cell_index, largest_cell_index)))) + 0x40000000u;
}

// The cell of a point on a surface with this unit normal: its coordinates along two axes
// perpendicular to the quantised normal, the coordinate along the normal, and a word that packs
// scale and normal. largest: edge of the largest cells, at least 1e-30. size: the requested edge,
// rounded down to `largest` over a power of two. A hash of the point's bits jitters it along the
// surface by up to half an edge, which turns the boundaries between cells into noise.
FN uvec4 query_cell(vec3 p, vec3 normal, real largest, real size) {
    uint exponent = float_bits(float32(clamp(size / largest, real(1e-6), real(1.0)))) >> 23u;
    real inverse = real(1.0) / (largest * real(bits_float(exponent << 23u)));
    uint packed = pack_unit(normal);
    real scale = cell_normal_steps / real(32767.0);
    uint nx = uint(int(floor((real(packed & 0xffffu) - real(32768.0)) * scale + real(0.5))) + 8);
    uint ny = uint(int(floor((real(packed >> 16u) - real(32768.0)) * scale + real(0.5))) + 8);
    uint steps = uint(32767.0 / 7.0);
    uint rounded = (32768u + (nx - 8u) * steps) | ((32768u + (ny - 8u) * steps) << 16u);
    Frame frame = make_frame(unpack_unit(rounded));
    uvec4 hash = pcg4d(uvec4(float_bits(float32(p.x)), float_bits(float32(p.y)),
                             float_bits(float32(p.z)), 0x2c1b3c6du));
    vec3 q = p * inverse;
    return uvec4(cell_index(dot3(frame.x, q) + to_unit(hash.x) - real(0.5)),
                 cell_index(dot3(frame.y, q) + to_unit(hash.y) - real(0.5)),
                 cell_index(dot3(frame.z, q) / cell_height), (exponent << 8u) | (nx << 4u) | ny);
}

// Number of steps in which to quantise directions for a lobe like GGX of this alpha (positive) that
// scatters this share of the light. A step is half of the lobe's width, and wider where the lobe
// counts for less, so that the answer changes little within it.
FN uint direction_steps(real alpha, real share) {
    return uint(ceil(clamp(PI / alpha * sqrt(share), real(1.0), real(60.0))));
}

// The cell of a unit vector, with this many steps on either side of 0 on the octahedron. Boundaries
// are jittered by a quarter of a step.
FN uint direction_cell(vec3 v, uint steps, uint random) {
    uint packed = pack_unit(v);
    real scale = real(steps) / real(32767.0);
    real x = (real(packed & 0xffffu) - real(32768.0)) * scale + real(0.25) * to_unit(random) +
             real(0.375);
    real y = (real(packed >> 16u) - real(32768.0)) * scale + real(0.25) * to_unit(random << 12u) +
             real(0.375);
    return (uint(int(floor(x)) + 64) << 8u) | uint(int(floor(y)) + 64);
}

// Orders slots at random, and inverts that order. A cell's owner is the first in this order: the
// first slot itself would lie on the same side of every cell. The constants are each other's
// inverse modulo 2^32.
FN uint shuffled_slot(uint slot) {
    uint v = slot * 0x9e3779b1u;
    return v ^ (v >> 16u);
}
FN uint slot_of_shuffled(uint v) { return (v ^ (v >> 16u)) * 0x0e8b2f51u; }

ARGAND_SHARED_END

#endif
