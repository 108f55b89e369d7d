#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/maths.h"
#include "shared/pose_records.h"

layout(set = 0, binding = 0) readonly buffer Parts { PosePart parts[]; };
layout(set = 0, binding = 1) readonly buffer Vertices { MovingVertex vertices[]; };
layout(set = 0, binding = 2) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = 3) writeonly buffer Boxes { PoseBox boxes[]; };
layout(push_constant) uniform Push { PoseBoxParams params; };

#include "shared/kernels/world/pose_boxes.h"
