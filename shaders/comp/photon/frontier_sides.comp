#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/frontier.h"
#include "shared/segments.h"

layout(set = 0, binding = 0) readonly buffer Places { uvec4 places[]; };
layout(set = 0, binding = 1) readonly buffer Segments { uint segments[]; };
layout(set = 0, binding = 2) readonly buffer Copies { uint copies[]; };
layout(set = 0, binding = 3) readonly buffer Boxes { BoxRecord boxes[]; };
layout(set = 0, binding = 4) writeonly buffer Flags { uint flags[]; };
layout(push_constant) uniform Push { FrontierParams params; };

#include "shared/kernels/photon/frontier_sides.h"
