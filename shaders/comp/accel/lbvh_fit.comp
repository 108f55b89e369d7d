#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "accel/count.glsl"
#include "shared/accel_records.h"
#include "shared/morton.h"

layout(set = 0, binding = 0) readonly buffer Boxes { vec4 boxes[]; };
layout(set = 0, binding = 1) readonly buffer Distances { uint distances[]; };    // see code_distances.comp
layout(set = 0, binding = 2) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 3) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 4) coherent buffer Ends { uint ends[]; };
layout(set = 0, binding = 5) coherent buffer Nodes { uvec4 nodes[]; };
layout(set = 0, binding = 6) coherent buffer Costs { uvec4 costs[]; };
layout(set = 0, binding = 7) writeonly buffer Parents { uint parents[]; };
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

// For trees that rays will traverse: also writes ForestCost per inner node, and as its parent 2 p if it is the left child
// of inner node p, 2 p + 1 if it is the right one (lbvh_end: it is the root).
layout(constant_id = 1) const bool for_rays = false;
// Whether the boxes are in the order of their codes; `order` then is only what leaves refer to.
layout(constant_id = 2) const bool in_order = false;
const float triangle_cost = 0.5;    // of a node's

float half_area(vec3 low, vec3 high) {
    vec3 size = max(high - low, vec3(0.0));
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

// The costs of an inner node from those of its children.
ForestCost join(ForestCost left, ForestCost right, float area) {
    float one_three = left.one + right.three;
    float two_two = left.two + right.two;
    float three_one = left.three + right.one;
    float least = min(min(one_three, two_two), three_one);
    ForestCost cost;
    cost.one = area + least;
    cost.split = least == one_three ? 1u : (least == two_two ? 2u : 3u);
    float split_two = left.one + right.one;
    bool two = split_two < cost.one;
    cost.two = two ? split_two : cost.one;
    cost.split |= two ? 8u : 4u;
    float one_two = left.one + right.two;
    float two_one = left.two + right.one;
    bool three = min(one_two, two_one) < cost.two;
    cost.three = three ? min(one_two, two_one) : cost.two;
    cost.split |= (three ? 48u : (two ? 32u : 16u)) | (one_two <= two_one ? 64u : 128u);
    return cost;
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
    uint first = leaf;
    uint last = leaf;
    uint before = leaf > 0u ? distances[leaf - 1u] : no_neighbour;
    uint after = distances[leaf];
    uint child = order[leaf];
    uint box = in_order ? leaf : child;
    vec3 low = boxes[2u * box].xyz;
    vec3 high = boxes[2u * box + 1u].xyz;
    uint right_child = 0u;
    uint place = 2u * leaf + 1u;
    ForestCost cost;
    if (for_rays) {
        cost.one = cost.two = cost.three = triangle_cost * half_area(low, high);
    }
    bool going = true;
    while (going) {
        bool root = before == no_neighbour && after == no_neighbour;
        bool is_left = after < before;
        if (first != last) {
            place = root ? 0u : 2u * (is_left ? last : first);
        }
        // What follows is the right child of the node split after `last`: a leaf if its own split is farther.
        uint escape = lbvh_end;
        if (after != no_neighbour) {
            uint next = last + 1u;
            uint beyond = distances[next];
            escape = 2u * next + (after < beyond ? 1u : 0u);
        }
        nodes[2u * place] = uvec4(floatBitsToUint(low), child);
        nodes[2u * place + 1u] = uvec4(floatBitsToUint(high), escape);
        if (for_rays && first != last) {
            costs[place >> 1u] = uvec4(floatBitsToUint(vec3(cost.one, cost.two, cost.three)), cost.split);
            if (root) {
                parents[0] = lbvh_end;
            }
            if ((child & 1u) == 0u) {
                parents[child >> 1u] = place;
            }
            if ((right_child & 1u) == 0u) {
                parents[right_child >> 1u] = place + 1u;
            }
        }
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
            vec3 sibling_low = uintBitsToFloat(nodes[2u * sibling].xyz);
            vec3 sibling_high = uintBitsToFloat(nodes[2u * sibling + 1u].xyz);
            if (for_rays) {
                ForestCost sibling_cost;
                sibling_cost.one = triangle_cost * half_area(sibling_low, sibling_high);
                sibling_cost.two = sibling_cost.three = sibling_cost.one;
                if (next != other) {
                    vec3 read = uintBitsToFloat(costs[next].xyz);
                    sibling_cost = ForestCost(read.x, read.y, read.z, 0u);
                }
                float area = half_area(min(low, sibling_low), max(high, sibling_high));
                if (is_left) {
                    cost = join(cost, sibling_cost, area);
                } else {
                    cost = join(sibling_cost, cost, area);
                }
            }
            low = min(low, sibling_low);
            high = max(high, sibling_high);
            child = is_left ? place : sibling;
            right_child = is_left ? sibling : place;
            if (is_left) {
                last = other;
                after = distances[last];
            } else {
                first = other;
                before = first > 0u ? distances[first - 1u] : no_neighbour;
            }
        }
    }
}
