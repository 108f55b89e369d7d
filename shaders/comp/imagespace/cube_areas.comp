#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "imagespace/cube_bindings.glsl"
#include "shared/cube_map.h"
#include "shared/fixed_point.h"
#include "shared/image_space_records.h"

layout(set = 0, binding = 4) readonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 5) buffer Candidates { CubeCandidate candidates[]; };
layout(push_constant) uniform Push { CubeCoverage params; };

#include "shared/kernels/imagespace/cube_areas.h"
