#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/frontier.h"
#include "shared/segments.h"

layout(set = 0, binding = 0) readonly buffer Ranges { SegmentRange ranges[]; };
layout(set = 0, binding = 1) readonly buffer Boxes { BoxRecord boxes[]; };
layout(set = 0, binding = 2) writeonly buffer Copies { uint copies[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(push_constant) uniform Push { FrontierParams params; };

#include "shared/kernels/photon/frontier_divide_again.h"
