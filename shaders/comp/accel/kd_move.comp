#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/kdtree_build.h"

layout(set = 0, binding = 0) readonly buffer Nodes { KdNode nodes[]; };
layout(set = 0, binding = 1) readonly buffer References { uvec4 references[]; };
layout(set = 0, binding = 2) readonly buffer Segments { uint segments[]; };
layout(set = 0, binding = 3) readonly buffer Starts { uint starts[]; };
layout(set = 0, binding = 4) readonly buffer Lefts { uint lefts[]; };
layout(set = 0, binding = 5) readonly buffer Rights { uint rights[]; };
layout(set = 0, binding = 6) readonly buffer LeftSums { uint left_sums[]; };
layout(set = 0, binding = 7) readonly buffer RightSums { uint right_sums[]; };
layout(set = 0, binding = 8) writeonly buffer NextReferences { uvec4 next_references[]; };
layout(set = 0, binding = 9) writeonly buffer NextSegments { uint next_segments[]; };
layout(set = 0, binding = 10) writeonly buffer Finished { uint finished[]; };
layout(set = 0, binding = 11) writeonly buffer FinishedNodes { uint finished_nodes[]; };
layout(push_constant) uniform Push { KdBuildParams params; };
// Lanes of an element: 1 for a point, 2 for a box. The first lane ends with its index.
layout(constant_id = 0) const uint lanes = 2u;

#include "shared/kernels/accel/kd_move.h"
