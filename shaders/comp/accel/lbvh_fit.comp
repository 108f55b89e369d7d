#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "accel/count.glsl"
#include "shared/accel_records.h"

layout(set = 0, binding = 0) readonly buffer Boxes { vec4 boxes[]; };
layout(set = 0, binding = 1) readonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 2) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 3) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 4) coherent buffer Ends { uint ends[]; };
layout(set = 0, binding = 5) coherent buffer Nodes { uvec4 nodes[]; };
layout(push_constant) uniform Push { AccelParams params; };

// Off where atomics are sequentially consistent anyway: lavapipe 22.3 takes a memory barrier for a control barrier, and
// in a loop that not all invocations run equally often loses its place.
layout(constant_id = 0) const bool fences = true;
void release_writes() {
    if (fences) {
        memoryBarrierBuffer();
    }
}
void acquire_writes() {
    if (fences) {
        memoryBarrierBuffer();
    }
}

// How far leaves i and i + 1 are apart: the highest bit in which their codes differ, or if none does, their places.
uint distance_after(uint i) {
    uint difference = codes[i] ^ codes[i + 1u];
    return difference != 0u ? 32u + uint(findMSB(difference)) : uint(findMSB(i ^ (i + 1u)));
}

// Builds the hierarchy from the leaves up, as Apetrei 2014 ("Fast and simple agglomerative LBVH construction"), but
// with the node numbers of Karras 2012 (see LbvhNode): a node that covers first..last is the left child of the node
// split after `last`, or the right child of the node split before `first`, whichever splits leaves that are closer.
// The invocation that comes second to a parent has both its children and goes on with it.
void main() {
    uint leaf = THREAD_INDEX;
    uint count = ELEMENT_COUNT;
    if (leaf >= count) {
        return;
    }
    const uint far = 64u;
    uint first = leaf;
    uint last = leaf;
    uint before = leaf > 0u ? distance_after(leaf - 1u) : far;
    uint after = leaf + 1u < count ? distance_after(leaf) : far;
    uint child = order[leaf];
    vec3 low = boxes[2u * child].xyz;
    vec3 high = boxes[2u * child + 1u].xyz;
    uint place = 2u * leaf + 1u;
    bool going = true;
    while (going) {
        bool root = before == far && after == far;
        bool is_left = after < before;
        if (first != last) {
            place = root ? 0u : 2u * (is_left ? last : first);
        }
        // What follows is the right child of the node split after `last`: a leaf if its own split is farther.
        uint escape = lbvh_end;
        if (after != far) {
            uint next = last + 1u;
            uint beyond = next + 1u < count ? distance_after(next) : far;
            escape = 2u * next + (after < beyond ? 1u : 0u);
        }
        nodes[2u * place] = uvec4(floatBitsToUint(low), child);
        nodes[2u * place + 1u] = uvec4(floatBitsToUint(high), escape);
        uint other = lbvh_end;
        if (!root) {
            release_writes();   // the node above is seen before its end is
            other = atomicExchange(ends[is_left ? last : first - 1u], is_left ? first : last);
        }
        going = other != lbvh_end;
        if (going) {
            acquire_writes();   // the sibling was written before its end was
            uint next = is_left ? last + 1u : first - 1u;
            uint sibling = 2u * next + (next == other ? 1u : 0u);
            low = min(low, uintBitsToFloat(nodes[2u * sibling].xyz));
            high = max(high, uintBitsToFloat(nodes[2u * sibling + 1u].xyz));
            child = is_left ? place : sibling;
            if (is_left) {
                last = other;
                after = last + 1u < count ? distance_after(last) : far;
            } else {
                first = other;
                before = first > 0u ? distance_after(first - 1u) : far;
            }
        }
    }
}
