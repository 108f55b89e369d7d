#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/area_records.h"
#include "shared/triangle_piece.h"

layout(set = 0, binding = 0) readonly buffer Pieces { uvec2 pieces[]; };
layout(set = 0, binding = 1) readonly buffer Places { uint places[]; };
layout(set = 0, binding = 2) writeonly buffer Divided { uvec2 divided[]; };
layout(push_constant) uniform Push { AreaPieceParams params; };

#include "shared/kernels/world/area_divide.h"
