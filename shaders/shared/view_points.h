// Points in view, in a hash table of cells along the surfaces, and rays to them from places nearby.
// What no such ray reaches is on the surface of a point in view, but behind a wall or inside a body
// that stands on it.
#ifndef ARGAND_SHARED_VIEW_POINTS_H
#define ARGAND_SHARED_VIEW_POINTS_H

#include "shared/prelude.h"
#include "shared/query_cell.h"
#include "shared/random.h"

ARGAND_SHARED_BEGIN

// An entry of the table. Each cell keeps one point at most.
struct ViewPointRecord {
    float32 x, y, z;
    uint normal; // of the side in view, packed (pack_photon_normal); no_view_point: no entry
    uvec4 cell;
};
CONSTANT uint no_view_point = 0xffffffffu;

// Rays from photons, or from area samples, to points in view. Lengths of rays that are none:
CONSTANT real no_view_link = -real(1.0);      // no point in view is near
CONSTANT real unknown_view_link = -real(2.0); // points may be near, but none in the same cell

// How they are found.
struct ViewLinkParams {
    uint first, count; // of this batch: photons, or sides of area samples
    uint counter;      // that holds the number of active rays
    uint sides;        // of a record: 1 for photons, 2 for area samples
    float32 cells;     // per length
    uint mask;         // entries of the table - 1; the number of entries is a power of two
    float32 error;     // bound of the rounding errors of positions
    uint searches;     // for rays to points in other cells than the place's own, so far
    uint last;         // 1: what this ray does not reach is not linked
    // Only records within this distance of this point are tested: area samples surround them.
    float32 corrected_x, corrected_y, corrected_z, corrected_distance;
};

// Rings of cells around a place's own in which points are near it.
CONSTANT int view_cell_rings = 2;

// The coordinate of a point in cells. Shifted, so that planes at round coordinates do not lie
// between two layers of cells, where rounding errors would put their points in both.
FN real in_view_cells(real x, real cells) { return x * cells + real(0.3719); }

// The cell of a point: three coordinates, and the axis to which the normal is nearest, with its
// sign.
FN uvec4 view_cell(vec3 p, vec3 normal, real cells) {
    vec3 n = abs(normal);
    uint axis = n.x > n.y ? (n.x > n.z ? 0u : 2u) : (n.y > n.z ? 1u : 2u);
    real along = axis == 0u ? normal.x : (axis == 1u ? normal.y : normal.z);
    return uvec4(cell_index(in_view_cells(p.x, cells)), cell_index(in_view_cells(p.y, cells)),
                 cell_index(in_view_cells(p.z, cells)), 2u * axis + (along < real(0.0) ? 1u : 0u));
}

// The entry of the table at which the search for a cell starts. mask: entries - 1.
FN uint view_cell_entry(uvec4 cell, uint mask) { return pcg4d(cell).x & mask; }

// A filter is a Bloom filter of cells with one hash, with so many bits for each entry of the table.
CONSTANT uint view_filter_bits = 64u;
FN uint view_filter_bit(uvec4 cell, uint mask) {
    return pcg4d(cell).y & ((mask + 1u) * view_filter_bits - 1u);
}

ARGAND_SHARED_END

#endif
