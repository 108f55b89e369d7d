#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/geometry_records.h"
#include "shared/maths.h"
#include "shared/queue_records.h"

layout(set = 0, binding = 0) readonly buffer Boxes { uint boxes[]; };
layout(set = 0, binding = 1) readonly buffer Moved { BoxRecord moved[]; };
layout(set = 0, binding = 2) buffer Emptied { uint emptied[]; };
layout(push_constant) uniform Push { QueueParams params; };

#include "shared/kernels/photon/queue_empty.h"
