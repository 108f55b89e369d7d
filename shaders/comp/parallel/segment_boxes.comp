#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/segments.h"

layout(set = 0, binding = 0) readonly buffer Elements { uvec4 elements[]; };
layout(set = 0, binding = 1) readonly buffer Segments { uint segments[]; };
layout(set = 0, binding = 2) buffer Boxes { uint box_words[]; };
layout(push_constant) uniform Push { SegmentRangeParams params; };
// Lanes of an element: 1 for a point, 2 for a box.
layout(constant_id = 0) const uint lanes = 2u;

#include "shared/kernels/parallel/segment_boxes.h"
