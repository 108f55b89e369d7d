#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/caster_records.h"
#include "shared/geometry_records.h"

layout(set = 0, binding = 0) readonly buffer Parts { CasterPart parts[]; };
layout(set = 0, binding = 1) readonly buffer Vertices { uint vertices[]; };
layout(set = 0, binding = 2) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 3) writeonly buffer Boxes { BoxRecord boxes[]; };
layout(push_constant) uniform Push { CasterBoxParams params; };

#include "shared/kernels/world/caster_boxes.h"
