#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/geometry_records.h"
#include "shared/intersect.h"
#include "accel/kd_ray_bindings.glsl"

//@ holds(hits, HitRecord)
layout(set = 0, binding = 8) buffer Hits { uvec4 hits[]; };
#define ALPHA_BINDING 9
#include "alpha_bindings.glsl"
layout(constant_id = 0) const bool resume = false; // resumes suspended rays
layout(push_constant) uniform Push { TraceParams params; };

#include "shared/kernels/accel/kd_closest_alpha.h"
