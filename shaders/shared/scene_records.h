#ifndef ARGAND_SHARED_SCENE_RECORDS_H
#define ARGAND_SHARED_SCENE_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Spheres at which photons may be aimed.
CONSTANT uint most_targets = 4u;
// Lights at whose close surfaces eye paths may be aimed.
CONSTANT uint most_close_lights = 32u;

// Data of the whole scene for kernels; a storage buffer holds one of these.
struct SceneRecord {
    float32 center_x, center_y, center_z, radius; // bounding sphere
    float32 sky_r, sky_g, sky_b;                  // radiance of a uniform sky [cd/m²]
    uint light_count;
    uint first_emitter;      // index of the first emissive triangle among the lights
    float32 sky_probability; // probability that a shadow ray is sent to the sky
    uint triangle_count;
    // Glossy lobes of at most this roughness are followed from the eye; see follow.h.
    float32 follow_roughness;
    float32 emitter_probability; // probability that a shadow ray is sent to an emissive triangle
    uint emitter_count;          // emissive triangles, which follow one another among the lights
    uint attributes;             // texture coordinates and colours of a vertex
    uint color_attribute;        // which of them is the colour
    // Spheres (center and radius) at which photons from all other lights are aimed, their number,
    // and the share of these photons for each (Targets).
    lane4 target_0, target_1, target_2, target_3;
    uint target_count;
    float32 target_share;
    float32 view_share;   // of the photons emitted or scattered outside `view` that are aimed at it
    uint sky_columns;     // of texels in the sky's picture; 0: there is none
    uint first_tangent;   // among the vertices' attributes: the first triangle's tangents
    uint cull_back_faces; // 1: eye paths go straight on through those of one-sided surfaces
    // Photons whose last ray was shorter than this come from nearby surfaces; 0: none do. With
    // follows_near they are not stored, and eye paths follow that light instead.
    float32 near_distance;
    uint follows_near;
    lane4 view; // sphere (center, radius) around most of what is in view
    // Lights close to surfaces (close_light.h): position, and distance of the surfaces; and the
    // greatest distance at which aimed paths pass the light.
    lane4 close_lights[most_close_lights];
    float32 close_reaches[most_close_lights];
    uint close_light_count;
    float32 close_share; // of the scattered eye paths for each of them
    uint pad0, pad1;
};

// A row of the table that chooses a light, by inversion of the cumulative probabilities: that keeps
// the even distribution of the random numbers. The table for shadow rays is followed by that for
// photons.
struct LightChoice {
    uint before;                 // probability of all rows before this one, times 2^32
    float32 probability;         // of this row's light
    float32 emitter_probability; // of all lights that belong to the same emitter
    uint pad;
};

ARGAND_SHARED_END

#endif
