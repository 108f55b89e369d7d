#ifndef ARGAND_SHARED_SCENE_RECORDS_H
#define ARGAND_SHARED_SCENE_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// What kernels need to know of the whole scene; one of these in a storage buffer.
struct SceneRecord {
    float32 center_x, center_y, center_z, radius; // bounding sphere
    float32 sky_r, sky_g, sky_b;                  // uniform radiance [cd/m²]
    uint light_count;
    float32 light_weight;    // sum of the lights' selection weights
    float32 sky_probability; // that a choice of light gives the sky
    uint triangle_count;
    float32
        follow_roughness; // glossy lobes at most this rough are followed from the eye, see follow.h
};

// One row of the alias table (Walker 1977) that chooses a light in proportion to its weight.
struct LightChoice {
    float32 keep;        // probability to stay in this row
    uint alias;          // the row to take otherwise
    float32 probability; // of the light of this row
    uint pad;
};

ARGAND_SHARED_END

#endif
