#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/frontier.h"
#include "shared/segments.h"

layout(set = 0, binding = 0) readonly buffer Ancestors { uint ancestors[]; };
layout(set = 0, binding = 1) readonly buffer FirstChunks { uint first_chunks[]; };
layout(set = 0, binding = 2) readonly buffer Nodes { FrontierNode nodes[]; };
layout(set = 0, binding = 3) readonly buffer Families { uint families[]; };
layout(set = 0, binding = 4) readonly buffer Ranges { SegmentRange ranges[]; };
layout(set = 0, binding = 5) readonly buffer Boxes { BoxRecord boxes[]; };
layout(set = 0, binding = 6) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 7) readonly buffer Sums { uint sums[]; };
layout(set = 0, binding = 8) writeonly buffer NextNodes { FrontierNode next_nodes[]; };
layout(set = 0, binding = 9) buffer Counters { uint counters[]; };
layout(push_constant) uniform Push { FrontierParams params; };

#include "shared/kernels/photon/frontier_nodes.h"
