#include "accel/traverse.glsl"

layout(set = 0, binding = 7) buffer Occluded { uint occluded[]; };
#define ALPHA_BINDING 8
#include "alpha_bindings.glsl"

#include "shared/kernels/accel/trace_any_alpha.h"
