// Cells of space in which queries share one answer of the photon map (Binder, Fricke, Keller 2018,
// "Fast Path Space Filtering by Jittered Spatial Hashing").
#ifndef ARGAND_SHARED_QUERY_CELL_H
#define ARGAND_SHARED_QUERY_CELL_H

#include "shared/frame.h"
#include "shared/random.h"

ARGAND_SHARED_BEGIN

// Steps of a cell's normal on either side of 0, on the octahedron: the axes are in the middle of
// theirs.
CONSTANT real cell_normal_steps = real(7.0);
// Height of a cell over its edge: densities are estimated within a few per cent of the radius off
// the tangent plane.
CONSTANT real cell_height = real(0.25);
CONSTANT real largest_cell_index = real(1073741824.0);

FN uint cell_index(real x) {
    return uint(int(floor(clamp(x, -largest_cell_index, largest_cell_index))) + 0x40000000);
}

// The cell of a point on a surface of unit normal `normal`: its place along two axes of the plane
// across the rounded normal, the plane's place, and on what scale and which normal. largest: edge
// of the largest cells, at least 1e-30; size: that is wanted, which is rounded down to the largest
// by a power of two. Points are moved along the surface by up to half an edge, at random by their
// bits, so that borders of cells become noise.
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

// Steps in which directions are rounded where lobes are as wide as GGX of this alpha, positive, and
// scatter this share of the light: half of the lobe's width, wider where it counts for less, so
// that what a step changes is little.
FN uint direction_steps(real alpha, real share) {
    return uint(ceil(clamp(PI / alpha * sqrt(share), real(1.0), real(60.0))));
}

// Of a unit vector, its cell of so many steps on either side of 0 on the octahedron; borders are
// moved at random, by a quarter of a step.
FN uint direction_cell(vec3 v, uint steps, uint random) {
    uint packed = pack_unit(v);
    real scale = real(steps) / real(32767.0);
    real x = (real(packed & 0xffffu) - real(32768.0)) * scale + real(0.25) * to_unit(random) +
             real(0.375);
    real y = (real(packed >> 16u) - real(32768.0)) * scale + real(0.25) * to_unit(random << 12u) +
             real(0.375);
    return (uint(int(floor(x)) + 64) << 8u) | uint(int(floor(y)) + 64);
}

// A number by which slots are ordered at random, and the slot of a number: the first of a cell's
// slots would be one at the same side of every cell. The constants are each other's inverse modulo
// 2^32.
FN uint shuffled_slot(uint slot) {
    uint v = slot * 0x9e3779b1u;
    return v ^ (v >> 16u);
}
FN uint slot_of_shuffled(uint v) { return (v ^ (v >> 16u)) * 0x0e8b2f51u; }

ARGAND_SHARED_END

#endif
