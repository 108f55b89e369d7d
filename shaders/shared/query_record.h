#ifndef ARGAND_SHARED_QUERY_RECORD_H
#define ARGAND_SHARED_QUERY_RECORD_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// A query of the photon map: a point at which estimated lobes scatter radiance towards the eye.
struct QueryRecord {
    float32 x, y, z;
    uint geometric_normal; // on the eye's side, packed (pack_unit)
    // Weight of the answer in the eye path; includes the albedo if the surface shares irradiance.
    float32 throughput_r, throughput_g, throughput_b;
    uint flags;                                          // query_*
    float32 reflectance_r, reflectance_g, reflectance_b; // BRDF of a Lambertian surface [1/sr]
    uint material; // key; queries with different keys share no answer
};

// BSDF parameters at a query on a non-Lambertian surface (ReflectionParameters, bsdf.h), and the
// vectors needed to evaluate it. Scenes without such surfaces have no such records.
struct QueryBsdfRecord {
    float32 base_r, base_g, base_b, opaque_share;
    float32 f0_r, f0_g, f0_b, f90;
    float32 metal_share, layer_share, alpha_across, exponent;
    float32 anisotropy_x, anisotropy_y;
    float32 coat, coat_alpha, film, film_ior, film_thickness;
    float32 coat_normal_x, coat_normal_y, coat_normal_z;
    float32 sheen_r, sheen_g, sheen_b, sheen_most, sheen_alpha;
    uint direction;      // towards the eye, packed
    uint shading_normal; // packed
};

CONSTANT uint query_front = 1u;      // the eye sees the front of the surface
CONSTANT uint query_lambertian = 2u; // the estimate needs only the reflectance of the BSDF
// With final gather, the first estimated vertex of an eye path queries caustic photons only. The
// next ones, also of paths that go on without one, query all photons up to a number of scatterings;
// the eye sees their light as indirect.
CONSTANT uint query_caustics = 4u;
CONSTANT uint query_gathers = 8u;
// Six bits: most scatterings of a photon that counts (photon.h).
CONSTANT uint query_scatterings_shift = 4u;
CONSTANT uint query_scatterings_mask = 0x3fu;
// Six bits: steps of directions within which an answer may be shared; 0 where it does not depend on
// directions.
CONSTANT uint query_steps_shift = 10u;
CONSTANT uint query_steps_mask = 0x3fu;
// The bits from here up: LOBE_* to estimate (bsdf.h).
CONSTANT uint query_lobes_shift = 16u;

// What an eye path queries; 0: nothing. Queries of one kind are answered together, and the path
// waits for the answer.
CONSTANT uint query_kind_map = 1u;
CONSTANT uint query_kind_caustics = 2u; // with query_caustics
CONSTANT uint query_kind_gathers = 3u;  // with query_gathers
CONSTANT uint query_kind_mask = 3u;
CONSTANT uint query_then_continues = 4u; // the path goes on after the answer

// Answer of the photon map: radiance towards the eye.
struct EstimateRecord {
    float32 indirect_r, indirect_g, indirect_b;
    float32 coverage; // share of the disc that lies on surfaces; 1 where it is not known
    float32 caustic_r, caustic_g, caustic_b;
    float32 uneven; // unevenness() of the indirect light (uneven.h); 0 where it is not known
};

// How nearby queries share an answer (query_cells).
struct QueryShareParams {
    float32 cell; // edge of the largest cells [length]; 0: answers are not shared
    // A cell's edge is at most pixel + pixel_slope × distance from the eye.
    float32 pixel, pixel_slope;
    uint mask; // entries of the hash table - 1; the number of entries is a power of two
    float32 eye_x, eye_y, eye_z;
    uint query_kind; // query_kind_*: which queries to process
};

CONSTANT uint no_query = 0xffffffffu;

// How answers are added to paths (estimate_add).
struct EstimateAddParams {
    // Of an answer that is taken; else the path goes on instead.
    float32 least_coverage, most_uneven;
};

ARGAND_SHARED_END

#endif
