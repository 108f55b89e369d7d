#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/area_records.h"
#include "shared/fixed_point.h"
#include "shared/triangle_piece.h"

layout(set = 0, binding = 0) readonly buffer Areas { vec2 areas[]; };
layout(set = 0, binding = 1) readonly buffer Pieces { uvec2 pieces[]; };
layout(set = 0, binding = 2) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 3) readonly buffer AreaState { uint area_state[]; };
layout(set = 0, binding = 4) writeonly buffer Lows { uint lows[]; };
layout(set = 0, binding = 5) writeonly buffer Highs { uint highs[]; };
layout(push_constant) uniform Push { AreaSumParams params; };

#include "shared/kernels/world/area_units.h"
