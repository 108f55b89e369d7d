#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/area_records.h"
#include "shared/morton.h"
#include "shared/triangle_piece.h"

layout(set = 0, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 1) readonly buffer Triangles { uvec4 triangles[]; };
layout(set = 0, binding = 2) readonly buffer Areas { vec2 areas[]; };
layout(set = 0, binding = 3) readonly buffer Pieces { uvec2 pieces[]; };
layout(set = 0, binding = 4) writeonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 5) writeonly buffer Order { uint order[]; };
layout(set = 0, binding = 6) writeonly buffer AreaBits { uint area_bits[]; };
layout(push_constant) uniform Push { AreaCodeParams params; };

#include "shared/kernels/world/area_codes.h"
