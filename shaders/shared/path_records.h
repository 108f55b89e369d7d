#ifndef ARGAND_SHARED_PATH_RECORDS_H
#define ARGAND_SHARED_PATH_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// A path traced from the eye, one per slot.
struct PathRecord {
    float32 throughput_r, throughput_g, throughput_b;
    // Solid-angle density of the current ray; 0: emission that it hits counts in full.
    float32 pdf;
    uint pixel, sample_index;
    // Low half: scattering vertices so far. High half: the upper bits of a float, by which
    // refraction has scaled the throughput (BsdfSample::eta_scale).
    uint vertices;
    // path_* bits; the low half counts scatterings after the first estimated vertex.
    uint state;
};

CONSTANT uint path_vertices_mask = 0xffffu;
CONSTANT uint path_unscaled = 0x3f800000u; // no vertices, no refraction
CONSTANT uint path_depth_mask = 0xffffu;
// The path has passed an estimated vertex, so what it finds is reflected light.
CONSTANT uint path_estimated = 0x10000u;
// Only followed lobes scattered the path since that vertex: a caustic path.
CONSTANT uint path_followed = 0x20000u;
// The path ends at the next surface; it is traced for the emission there only, unless the photon
// map's estimate is not taken (estimate_add).
CONSTANT uint path_seeks_emission = 0x40000u;
// Only followed lobes scattered the path since it met a surface near an estimated vertex whose
// estimate was taken. That estimate has the caustics which such a path finds.
CONSTANT uint path_near_followed = 0x80000u;

// Radiance that a path has gathered so far, by layer (docs/path-classes.md).
struct LayersRecord {
    float32 direct_r, direct_g, direct_b, pad0;
    float32 indirect_r, indirect_g, indirect_b, pad1;
    float32 caustic_r, caustic_g, caustic_b, pad2;
};

CONSTANT uint layer_direct = 0u;
CONSTANT uint layer_indirect = 1u;
CONSTANT uint layer_caustic = 2u;

// Radiance that a shadow ray adds if it is not blocked: the light that the estimated and the
// followed lobes scatter.
struct ShadowRecord {
    float32 estimated_r, estimated_g, estimated_b;
    uint layers; // of the estimated part, and times 4 of the followed one
    float32 followed_r, followed_g, followed_b;
    uint light; // index of the light to which the ray is sent
};

// Sums over a pixel's samples, with their rounding errors (Kahan).
struct FilmRecord {
    float32 direct_r, direct_g, direct_b;
    uint samples; // the low word of their number
    float32 indirect_r, indirect_g, indirect_b;
    uint samples_high;
    float32 caustic_r, caustic_g, caustic_b;
    uint non_finite; // samples left out because they are not finite: the low word of their number
    float32 lost_direct_r, lost_direct_g, lost_direct_b;
    uint non_finite_high;
    float32 lost_indirect_r, lost_indirect_g, lost_indirect_b, pad0;
    float32 lost_caustic_r, lost_caustic_g, lost_caustic_b, pad1;
};

// How many of the photon map's estimates are not taken, so that paths that seek emission go on.
CONSTANT uint untaken_never = 0u;
CONSTANT uint untaken_seldom = 1u;
CONSTANT uint untaken_often = 2u;

// A batch of eye paths: slot = pixel in the batch × samples per pixel + sample.
struct EyeBatch {
    uint seed;
    uint first_pixel, pixels;   // of the width × height pixels of the image
    uint first_sample, samples; // per pixel in this batch
    uint width, height;
    uint bounces;        // most scatterings between the light and the first estimated vertex
    uint shares_queries; // whether paths share answers of the photon map
    // If paths do not share: only samples first_sample, first_sample + query_step, ... query the
    // photon map, and each answer counts query_weight times.
    uint query_step;
    float32 query_weight;
    uint untaken;          // untaken_*
    uint first_film_pixel; // first pixel of this part of the film
    // The film is this part of the image: pixels above are numbered in the film, and random numbers
    // are those of the pixel in the image.
    uint crop_x, crop_y, crop_width;
    float32 light_paths; // photons whose paths find the same light, for each sample of a pixel
};

// What shares the work of eye paths beside the photon map.
CONSTANT uint variant_plain = 0u;
// Paths query the map one scattering later, except for caustics.
CONSTANT uint variant_final_gather = 1u;
// Paths of a path tracer, beside light paths.
CONSTANT uint variant_light_paths = 2u;

ARGAND_SHARED_END

#endif
