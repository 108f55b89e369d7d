#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/frontier.h"
#include "shared/segments.h"

layout(set = 0, binding = 0) readonly buffer Sources { uint sources[]; };
layout(set = 0, binding = 1) readonly buffer Ranges { SegmentRange ranges[]; };
layout(set = 0, binding = 2) readonly buffer Copies { uint copies[]; };
layout(set = 0, binding = 3) readonly buffer Parts { uint parts[]; };
layout(set = 0, binding = 4) readonly buffer Lefts { uint lefts[]; };
layout(set = 0, binding = 5) readonly buffer Ancestors { uint ancestors[]; };
layout(set = 0, binding = 6) writeonly buffer NextRanges { SegmentRange next_ranges[]; };
layout(set = 0, binding = 7) writeonly buffer NextAncestors { uint next_ancestors[]; };
layout(set = 0, binding = 8) writeonly buffer Families { uint families[]; };
layout(push_constant) uniform Push { FrontierParams params; };

#include "shared/kernels/photon/frontier_parts.h"
