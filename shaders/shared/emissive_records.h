#ifndef ARGAND_SHARED_EMISSIVE_RECORDS_H
#define ARGAND_SHARED_EMISSIVE_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Successive emissive triangles of one emitter, of which one invocation makes lights: a range of
// the list of all emissive triangles.
struct EmissivePart {
    uint first, count;
};
CONSTANT uint most_triangles_of_emissive_part = 128u;

// How a triangle shines by its texels: the mean colour of those that it shows, and where its tree
// begins among the words of the texels (texel_tree.h). White and 0 if it has no emissive texture.
struct TexelMean {
    float32 r, g, b;
    uint root;
};

// What a part emits. Laid out in 16-byte lanes.
struct EmissiveSum {
    float32 power_r, power_g, power_b, pad0;
    float32 middle_x, middle_y, middle_z, pad1; // of its triangles, by power
};

struct EmissiveLightParams {
    uint parts;
    uint first_light; // the index of the first triangle among the lights
};

// Rows are the lights before the emissive triangles, the parts of these, and the lights behind.
struct EmissiveChoiceParams {
    uint rows;
    uint parts;
    uint triangles;
    uint first_light;
    uint first_choice; // where the table of choices begins
};

ARGAND_SHARED_END

#endif
