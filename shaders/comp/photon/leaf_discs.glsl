// Declarations of leaf_discs.comp and leaf_discs_texels.comp, which define TEXELS (0 or 1).
#include "photon/frontier_query.glsl"

layout(constant_id = 1) const bool uniform_kernel = false;
layout(constant_id = 4) const bool ball = false;

#include "shared/kernels/photon/leaf_discs.h"
