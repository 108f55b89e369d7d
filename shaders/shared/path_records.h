#ifndef ARGAND_SHARED_PATH_RECORDS_H
#define ARGAND_SHARED_PATH_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// A path that is being traced from the eye, one per slot.
struct PathRecord {
    float32 throughput_r, throughput_g, throughput_b;
    float32 pdf; // solid-angle density of the current ray; 0: emission it meets counts in full
    uint pixel, sample_index;
    uint vertices; // scattering vertices so far
    uint state; // path_* bits, and the scatterings after the first estimated vertex in the low half
};

CONSTANT uint path_depth_mask = 0xffffu;
CONSTANT uint path_estimated =
    0x10000u; // an estimated vertex lies behind: what is found counts as reflected light
CONSTANT uint path_followed =
    0x20000u; // all scatterings since that vertex were followed lobes (a caustic path)
CONSTANT uint path_seeks_emission =
    0x40000u; // ends at the next surface, whose emission is all it is traced for

// Radiance that a path has gathered so far, by layer (docs/design.md: "Which path is whose").
struct LayersRecord {
    float32 direct_r, direct_g, direct_b, pad0;
    float32 indirect_r, indirect_g, indirect_b, pad1;
    float32 caustic_r, caustic_g, caustic_b, pad2;
};

CONSTANT uint layer_direct = 0u;
CONSTANT uint layer_indirect = 1u;
CONSTANT uint layer_caustic = 2u;

// What a shadow ray adds if nothing is in its way: the light that the estimated and the followed
// lobes scatter.
struct ShadowRecord {
    float32 estimated_r, estimated_g, estimated_b;
    uint estimated_layer;
    float32 followed_r, followed_g, followed_b;
    uint followed_layer;
};

// Sums over a pixel's samples, and what rounding took from them (Kahan).
struct FilmRecord {
    float32 direct_r, direct_g, direct_b;
    uint samples;
    float32 indirect_r, indirect_g, indirect_b;
    uint pad3;
    float32 caustic_r, caustic_g, caustic_b;
    uint non_finite; // samples left out because they were not finite
    float32 lost_direct_r, lost_direct_g, lost_direct_b, pad0;
    float32 lost_indirect_r, lost_indirect_g, lost_indirect_b, pad1;
    float32 lost_caustic_r, lost_caustic_g, lost_caustic_b, pad2;
};

// A batch of eye paths: slot = pixel in the batch × samples per pixel + sample.
struct EyeBatch {
    uint seed;
    uint first_pixel, pixels;   // of the picture's width × height
    uint first_sample, samples; // per pixel in this batch
    uint width, height;
    uint bounces;          // the most scatterings between the light and the first estimated vertex
    uint shares_queries;   // whether paths share the photon map's answers
    uint query_step;       // if not, samples first_sample, first_sample + query_step, ... ask,
    float32 query_weight;  // and each counts by so much
    uint first_film_pixel; // of the part of the film
};

ARGAND_SHARED_END

#endif
