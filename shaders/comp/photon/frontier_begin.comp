#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/frontier.h"
#include "shared/segments.h"

layout(set = 0, binding = 0) readonly buffer Boxes { BoxRecord boxes[]; };
layout(set = 0, binding = 1) readonly buffer Flags { uint flags[]; };
layout(set = 0, binding = 2) readonly buffer Sums { uint sums[]; };
layout(set = 0, binding = 3) writeonly buffer Ranges { SegmentRange ranges[]; };
layout(set = 0, binding = 4) writeonly buffer Nodes { FrontierNode nodes[]; };
layout(set = 0, binding = 5) writeonly buffer Counters { uint counters[]; };
layout(push_constant) uniform Push { FrontierParams params; };

#include "shared/kernels/photon/frontier_begin.h"
