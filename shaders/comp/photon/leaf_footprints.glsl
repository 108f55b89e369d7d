// Declarations of leaf_footprints.comp and leaf_footprints_texels.comp, which define TEXELS (0 or 1).
#include "photon/frontier_query.glsl"
#include "shared/footprint.h"

#if TEXELS
layout(set = 0, binding = 8) uniform utextureBuffer footprints;
#define FOOTPRINTS(i) texelFetch(footprints, int(i))
#else
layout(set = 0, binding = 8) readonly buffer Footprints { uvec4 footprints[]; };
#define FOOTPRINTS(i) footprints[i]
#endif

layout(constant_id = 1) const bool uniform_kernel = false;

#include "shared/kernels/photon/leaf_footprints.h"
