// Declarations of nearest_gather.comp and nearest_gather_texels.comp, which define TEXELS (0 or 1).
#include "photon/query.glsl"
#include "shared/nearest_records.h"

layout(set = 0, binding = 9) buffer States { NearestRecord states[]; };
layout(set = 0, binding = 10) buffer Words { uint suspended_words[]; };
// Squared radius of each slot's disc of caustics.
layout(set = 0, binding = 11) writeonly buffer CausticDiscs { float caustic_discs[]; };

shared uint words[nearest_words * nearest_group];
#define WORD(i) words[(i) * nearest_group + gl_LocalInvocationIndex]

#include "shared/kernels/photon/nearest_gather.h"
