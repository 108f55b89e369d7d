#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/kdtree_build.h"

layout(set = 0, binding = 0) readonly buffer Nodes { KdNode nodes[]; };
layout(set = 0, binding = 1) buffer Places { KdPlace places[]; };
layout(push_constant) uniform Push { KdBuildParams params; };

#include "shared/kernels/accel/kd_places.h"
