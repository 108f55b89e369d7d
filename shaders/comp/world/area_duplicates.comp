#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/area_records.h"

layout(set = 0, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 1) readonly buffer Triangles { uvec4 triangles[]; };
layout(set = 0, binding = 2) readonly buffer Stores { uint stores[]; };
layout(set = 0, binding = 3) readonly buffer Hashes { uint hashes[]; };
layout(set = 0, binding = 4) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 5) buffer Areas { vec2 areas[]; };
layout(push_constant) uniform Push { AreaTriangleParams params; };

#include "shared/kernels/world/area_duplicates.h"
