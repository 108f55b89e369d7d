#ifndef ARGAND_SHARED_LIGHT_PATH_RECORDS_H
#define ARGAND_SHARED_LIGHT_PATH_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// What an eye path remembers for the weights of what it finds (light_path.h).
struct EyeWeightRecord {
    // 1 over the density of eye paths that its first scattering has; 0: light paths do not find
    // the path. Until then the negative of density_of_camera_rays().
    float32 scarcity;
    // 1 over the density of directions in which its last scattering sent it; 0: shadow rays do not
    // find the same light. Until the first one 1 if the camera is perspective, else 0.
    float32 last;
};

// What a light path remembers for its weights: the densities of light_path.h at its first vertex
// behind the light.
struct LightPathRecord {
    float32 arriving, by_shadow_ray, by_scattering;
    float32 passed_hidden; // whether a surface on its way lies inside a solid of higher rank
};

// What a light path brings to a pixel.
struct SplatRecord {
    float32 r, g, b;
    uint place; // 2 × pixel of the film, plus 1 in the layer of caustics; no_place: nothing
};

CONSTANT uint no_place = 0xffffffffu;

// Photons whose hits are connected with the eye.
struct ConnectParams {
    uint seed;
    uint first;          // number of the batch's first photon
    uint bounces;        // most scatterings of a photon before it is seen
    float32 photons;     // of the pass for each sample of a pixel
    uint width, height;  // of the image
    uint crop_x, crop_y; // of the film in the image
    uint crop_width, crop_height;
    uint samples; // of a pixel
};

// Splats that are added to a part of the film.
struct SplatParams {
    uint first, pixels; // of the part
    uint none;          // key of slots without a splat: 2 × all pixels of the film
    float32 samples;    // for which a splat counts
};

ARGAND_SHARED_END

#endif
