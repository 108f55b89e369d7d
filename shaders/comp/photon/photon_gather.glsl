// Declarations of photon_gather.comp and photon_gather_texels.comp, which define TEXELS (0 or 1).
#include "photon/query_state.glsl"

layout(constant_id = 1) const bool uniform_kernel = false;
layout(constant_id = 4) const bool ball = false;

#include "shared/kernels/photon/photon_gather.h"
