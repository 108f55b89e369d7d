#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/segments.h"

layout(set = 0, binding = 0) readonly buffer Flags { uint flags[]; };
layout(set = 0, binding = 1) readonly buffer Sums { uint sums[]; };
layout(set = 0, binding = 2) readonly buffer Segments { uint segments[]; };
layout(set = 0, binding = 3) readonly buffer Ranges { SegmentRange ranges[]; };
layout(set = 0, binding = 4) writeonly buffer Places { uint places[]; };
layout(set = 0, binding = 5) writeonly buffer Lefts { uint lefts[]; };
layout(push_constant) uniform Push { SegmentRangeParams params; };

#include "shared/kernels/parallel/partition_places.h"
