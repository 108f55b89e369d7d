#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/kdtree_build.h"

layout(set = 0, binding = 0) readonly buffer Nodes { KdNode nodes[]; };
layout(set = 0, binding = 1) readonly buffer Plans { KdPlanes plans[]; };
layout(set = 0, binding = 2) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 3) writeonly buffer Choices { KdChoice choices[]; };
layout(set = 0, binding = 4) writeonly buffer SplitCounts { uint split_counts[]; };
layout(set = 0, binding = 5) writeonly buffer NextCounts { uint next_counts[]; };
layout(set = 0, binding = 6) writeonly buffer FinishedCounts { uint finished_counts[]; };
layout(set = 0, binding = 7) buffer Counters { uint counters[]; };
layout(set = 0, binding = 8) writeonly buffer Starts { uint starts[]; };
layout(set = 0, binding = 9) readonly buffer Cells { BoxRecord cells[]; };
layout(push_constant) uniform Push { KdBuildParams params; };

#include "shared/kernels/accel/kd_decide.h"
