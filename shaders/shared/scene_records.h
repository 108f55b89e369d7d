#ifndef ARGAND_SHARED_SCENE_RECORDS_H
#define ARGAND_SHARED_SCENE_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Data of the whole scene for kernels; a storage buffer holds one of these.
struct SceneRecord {
    float32 center_x, center_y, center_z, radius; // bounding sphere
    float32 sky_r, sky_g, sky_b;                  // uniform radiance [cd/m²]
    uint light_count;
    float32 light_weight;    // sum of the lights' selection weights
    float32 sky_probability; // probability that a choice of light selects the sky
    uint triangle_count;
    // Glossy lobes of at most this roughness are followed from the eye; see follow.h.
    float32 follow_roughness;
    float32 emitter_probability; // probability that a choice of light selects an emissive triangle
    uint pad0, pad1, pad2;
};

// A row of the alias table (Walker 1977) that chooses a light in proportion to its weight.
struct LightChoice {
    float32 keep;        // probability of staying in this row
    uint alias;          // the row to take otherwise
    float32 probability; // of this row's light
    uint pad;
};

ARGAND_SHARED_END

#endif
