#ifndef ARGAND_SHARED_LIGHT_RECORD_H
#define ARGAND_SHARED_LIGHT_RECORD_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

CONSTANT uint light_point = 0u;
CONSTANT uint light_spot = 1u;
CONSTANT uint light_directional = 2u;
CONSTANT uint light_triangle = 3u;
CONSTANT uint light_sky = 4u;     // the same radiance from all directions
CONSTANT uint light_picture = 5u; // a sky with a picture and a sun (sky_record.h)

// Bit masks of kinds: 1u << light_*.
CONSTANT uint all_light_kinds = 63u;
CONSTANT uint light_kinds_at_a_point = 3u;    // point and spot
CONSTANT uint light_kinds_from_outside = 52u; // directional, sky and picture

// A light of any kind. Laid out in 16-byte lanes.
struct LightRecord {
    // Position (point, spot), first vertex (triangle) or middle of the aimed photons (from
    // outside).
    float32 x, y, z;
    uint kind;
    // Intensity [cd] (point, spot), irradiance [lux] (directional) or radiance [cd/m²]; of a
    // picture the mean, but after a direction has been sampled, the direction's radiance over `ey`.
    float32 r, g, b;
    // Spot; triangle: the root of its tree of texels (texel_tree.h), an integer below 2^24; 0: it
    // has none.
    float32 cos_inner;
    // Unit direction in which light travels (spot, directional; picture after sampling), or second
    // vertex (triangle).
    float32 dx, dy, dz;
    float32 cos_outer; // spot
    // Third vertex (triangle). From outside: ex is the radius of the aimed photons' disc. Picture:
    // ey is the density with which the direction was sampled over that of even directions.
    float32 ex, ey, ez;
    // Triangle: twice its index among the scene's triangles, plus 1 if it emits from its back too.
    // From outside: index of the root of its AimNodes; 0: its photons are not aimed.
    uint triangle_and_sides;
};

ARGAND_SHARED_END

#endif
