// What the kernels that trace rays share. They define TEXELS (0 or 1) first.
#include "shared/geometry_records.h"
#include "shared/intersect.h"
#include "accel/traverse_bindings.glsl"

layout(constant_id = 0) const bool resume = false;  // resumes suspended rays
layout(push_constant) uniform Push { TraceParams params; };
