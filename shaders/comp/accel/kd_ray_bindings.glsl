// The buffers of the kernels that trace rays through a kd-tree.
#include "shared/accel_records.h"
#include "shared/kdtree.h"

layout(set = 0, binding = 0) readonly buffer Words { uint words[]; };
layout(set = 0, binding = 1) readonly buffer Boxes { vec4 boxes[]; };
layout(set = 0, binding = 2) readonly buffer Triangles { vec4 triangles[]; };
#define TRIANGLES(i) triangles[i]
layout(set = 0, binding = 3) readonly buffer Rays { vec4 rays[]; };
layout(set = 0, binding = 4) readonly buffer Active { uint active_rays[]; };
layout(set = 0, binding = 5) readonly buffer Counts { uint counts[]; };
//@ unordered(suspended, suspended_head, kd_suspended_stride)
layout(set = 0, binding = 6) buffer Suspended { uint suspended[]; };
layout(set = 0, binding = 7) buffer Unfinished { uint unfinished[]; };
