#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "imagespace/cube_bindings.glsl"
#include "shared/cube_map.h"
#include "shared/image_space_records.h"

layout(set = 0, binding = 4) buffer Masks { uint masks[]; };
layout(set = 0, binding = 5) readonly buffer Points { vec4 points[]; };
layout(set = 0, binding = 6) buffer Candidates { CubeCandidate candidates[]; };
layout(push_constant) uniform Push { CubeCoverage params; };

#include "shared/kernels/imagespace/cube_points.h"
