#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/cube_map.h"
#include "shared/fixed_point.h"
#include "shared/image_space_records.h"

layout(set = 0, binding = 0) readonly buffer Texels { uvec2 texels[]; };
layout(set = 0, binding = 1) readonly buffer Centers { vec4 centers[]; };
layout(set = 0, binding = 2) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 3) readonly buffer Triangles { uvec4 triangles[]; };
layout(set = 0, binding = 4) readonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 5) buffer Candidates { CubeCandidate candidates[]; };
layout(push_constant) uniform Push { CubeCoverage params; };

#include "shared/kernels/imagespace/cube_areas.h"
