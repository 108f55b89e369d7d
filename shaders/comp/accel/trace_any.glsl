#include "accel/traverse.glsl"

layout(set = 0, binding = 7) writeonly buffer Occluded { uint occluded[]; };

#include "shared/kernels/accel/trace_any.h"
