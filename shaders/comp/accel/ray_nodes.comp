#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/accel_records.h"

layout(set = 0, binding = 0) readonly buffer Tree { uvec4 tree[]; };
layout(set = 0, binding = 1) writeonly buffer Nodes { uvec4 nodes[]; };
layout(push_constant) uniform Push { AccelParams params; };

// Gathers both children's boxes into each inner node. Leaves' references become those of their triangles.
void main() {
    uint i = THREAD_INDEX;
    if (i + 1u >= params.count) {
        return;
    }
    uint left = tree[4u * i].w;
    uvec4 left_low = tree[2u * left];
    uvec4 left_high = tree[2u * left + 1u];
    uint right = left_high.w;
    uvec4 right_low = tree[2u * right];
    uvec4 right_high = tree[2u * right + 1u];
    nodes[4u * i] = uvec4(left_low.xyz, left);
    nodes[4u * i + 1u] = uvec4(left_high.xyz, right);
    nodes[4u * i + 2u] = uvec4(right_low.xyz, 0u);
    nodes[4u * i + 3u] = uvec4(right_high.xyz, 0u);
}
