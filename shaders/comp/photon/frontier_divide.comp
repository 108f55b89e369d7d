#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/frontier.h"
#include "shared/segments.h"

layout(set = 0, binding = 0) readonly buffer Nodes { FrontierNode nodes[]; };
layout(set = 0, binding = 1) writeonly buffer Copies { uint copies[]; };
layout(set = 0, binding = 2) writeonly buffer Chunks { uint chunks[]; };
layout(push_constant) uniform Push { FrontierParams params; };

#include "shared/kernels/photon/frontier_divide.h"
