#ifndef ARGAND_SHARED_QUERY_RECORD_H
#define ARGAND_SHARED_QUERY_RECORD_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// A point at which the photon map is asked for the radiance that estimated lobes scatter towards
// the eye.
struct QueryRecord {
    float32 x, y, z;
    uint material;
    float32 throughput_r, throughput_g,
        throughput_b;      // by which the answer counts for the path to the eye
    uint direction;        // towards the eye, packed (pack_unit)
    uint geometric_normal; // towards the eye's side, packed
    uint shading_normal;   // packed
    uint lobes;            // LOBE_* to be estimated
    uint flags;            // query_*
};

CONSTANT uint query_front = 1u; // the surface is seen from its front
CONSTANT uint query_white =
    2u; // Lambertian, with its albedo in the throughput: asks for what albedo 1 scatters
CONSTANT uint query_steps_shift =
    10u; // above: steps of directions in which an answer may be shared; 0 where white
// With final gather the first estimated vertex of an eye path asks for caustics only, and the next
// one for all light of a limited number of scatterings, which is indirect light as the eye sees it.
CONSTANT uint query_caustics = 4u;
CONSTANT uint query_gathers = 8u;
CONSTANT uint query_scatterings_shift = 4u; // six bits: the most of a photon that counts (photon.h)
CONSTANT uint query_scatterings_mask = 0x3fu;

// Flags of paths that ask: for what they ask is found together.
CONSTANT uint asks_map = 1u;
CONSTANT uint asks_caustics = 2u; // by query_caustics

// What the photon map answers: radiance towards the eye.
struct EstimateRecord {
    float32 indirect_r, indirect_g, indirect_b, pad0;
    float32 caustic_r, caustic_g, caustic_b, pad1;
};

// How queries nearby share an answer (query_cells).
struct QueryShareParams {
    float32 cell; // edge of a cell at most [length]; 0: nothing is shared
    float32 pixel,
        pixel_slope; // a cell is no larger than pixel + pixel_slope × distance from the eye
    uint mask;       // entries of the table - 1, a power of two - 1
    float32 eye_x, eye_y, eye_z;
    uint asks; // asks_*: which queries this is about
};

CONSTANT uint no_query = 0xffffffffu;

ARGAND_SHARED_END

#endif
