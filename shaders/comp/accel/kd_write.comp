#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/kdtree_build.h"

layout(set = 0, binding = 0) readonly buffer Nodes { KdNode nodes[]; };
layout(set = 0, binding = 1) readonly buffer Places { KdPlace places[]; };
layout(set = 0, binding = 2) readonly buffer Finished { uint finished[]; };
layout(set = 0, binding = 3) writeonly buffer Words { uint words[]; };
layout(set = 0, binding = 4) writeonly buffer Addresses { uint addresses[]; };
layout(set = 0, binding = 5) readonly buffer Cells { BoxRecord cells[]; };
layout(set = 0, binding = 6) writeonly buffer Boxes { BoxRecord boxes[]; };
layout(push_constant) uniform Push { KdBuildParams params; };

#include "shared/kernels/accel/kd_write.h"
