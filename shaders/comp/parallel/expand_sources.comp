#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/segments.h"

layout(set = 0, binding = 0) readonly buffer Sums { uint sums[]; };
layout(set = 0, binding = 1) writeonly buffer Sources { uint sources[]; };
layout(push_constant) uniform Push { ExpandParams params; };

#include "shared/kernels/parallel/expand_sources.h"
