// Walking a photon map: its tree in depth-first order, by escape references, from block to block. TEXELS (0 or 1) says
// through what the map is read.
#include "shared/accel_records.h"
#include "shared/photon.h"

#if TEXELS
layout(set = 0, binding = 0) uniform utextureBuffer nodes;
layout(set = 0, binding = 1) uniform utextureBuffer photons;
#define NODES(i) texelFetch(nodes, int(i))
#define PHOTONS(i) texelFetch(photons, int(i))
#else
layout(set = 0, binding = 0) readonly buffer Nodes { uvec4 nodes[]; };
layout(set = 0, binding = 1) readonly buffer Photons { uvec4 photons[]; };
#define NODES(i) nodes[i]
#define PHOTONS(i) photons[i]
#endif
layout(set = 0, binding = 2) readonly buffer Counters { uint counters[]; };

const uint no_block = 0xffffffffu;

uint first_node() {
    uint blocks = counters[counter_blocks];
    return blocks == 0u ? lbvh_end : blocks == 1u ? 1u : 0u;
}

// The next block, from `node` on, that a ball about p reaches, or no_block at the tree's end or after `limit` steps.
// Apart from the photons' loop, so that all lanes of a subgroup look for a block, and then go through theirs together:
// 2.2 times as fast on lavapipe.
uint next_block(vec3 p, float radius2, uint limit, inout uint node, inout uint steps) {
    uint block = no_block;
    while (block == no_block && node != lbvh_end && steps < limit) {
        ++steps;
        uvec4 low = NODES(2u * node);
        uvec4 high = NODES(2u * node + 1u);
        vec3 outside = max(max(uintBitsToFloat(low.xyz) - p, p - uintBitsToFloat(high.xyz)), vec3(0.0));
        bool near = dot3(outside, outside) <= radius2;
        bool leaf = (node & 1u) != 0u;
        block = near && leaf ? low.w : no_block;
        node = near && !leaf ? low.w : high.w;
    }
    return block;
}
