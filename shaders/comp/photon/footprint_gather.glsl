// Declarations of footprint_gather.comp and footprint_gather_texels.comp, which define TEXELS (0 or 1).
#include "photon/query_state.glsl"
#include "shared/footprint.h"

#if TEXELS
layout(set = 0, binding = 10) uniform utextureBuffer footprints;
#define FOOTPRINTS(i) texelFetch(footprints, int(i))
#else
layout(set = 0, binding = 10) readonly buffer Footprints { uvec4 footprints[]; };
#define FOOTPRINTS(i) footprints[i]
#endif

layout(constant_id = 1) const bool uniform_kernel = false;

#include "shared/kernels/photon/footprint_gather.h"
