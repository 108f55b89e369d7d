// Declarations of photon_gather.comp and photon_gather_texels.comp, which define TEXELS (0 or 1).
#include "photon/query_state.glsl"

#include "shared/kernels/photon/photon_gather.h"
