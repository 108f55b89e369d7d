#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/segments.h"

layout(set = 0, binding = 0) buffer Boxes { uint box_words[]; };
layout(push_constant) uniform Push { SegmentRangeParams params; };

#include "shared/kernels/parallel/segment_boxes_end.h"
