// The buffers of the kernels that trace rays. With TEXELS they read the tree through texture units,
// which is faster on CPUs.
#include "shared/accel_records.h"

#if TEXELS
layout(set = 0, binding = 0) uniform utextureBuffer nodes;
layout(set = 0, binding = 1) uniform utextureBuffer triangles;
#define NODES(i) texelFetch(nodes, int(i))
#define TRIANGLES(i) uintBitsToFloat(texelFetch(triangles, int(i)))
#else
layout(set = 0, binding = 0) readonly buffer Nodes { uvec4 nodes[]; };
layout(set = 0, binding = 1) readonly buffer Triangles { vec4 triangles[]; };
#define NODES(i) nodes[i]
#define TRIANGLES(i) triangles[i]
#endif
layout(set = 0, binding = 2) readonly buffer Rays { vec4 rays[]; };
layout(set = 0, binding = 3) readonly buffer Active { uint active_rays[]; };
layout(set = 0, binding = 4) readonly buffer Counts { uint counts[]; };
//@ unordered(suspended, suspended_head, suspended_stride)
layout(set = 0, binding = 5) buffer Suspended { uint suspended[]; };
layout(set = 0, binding = 6) buffer Unfinished { uint unfinished[]; };
