#include "shared/kernels/count.h"

CONSTANT real triangle_cost = real(0.5); // of a node's

FN real half_area(vec3 low, vec3 high) {
    vec3 size = max(high - low, vec3(real(0.0)));
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

// The costs of an inner node from those of its children.
FN ForestCost join(ForestCost left, ForestCost right, real area) {
    real one_three = left.one + right.three;
    real two_two = left.two + right.two;
    real three_one = left.three + right.one;
    real least = min(min(one_three, two_two), three_one);
    ForestCost cost;
    cost.one = area + least;
    cost.split = least == one_three ? 1u : (least == two_two ? 2u : 3u);
    real split_two = left.one + right.one;
    bool two = split_two < cost.one;
    cost.two = two ? split_two : cost.one;
    cost.split |= two ? 8u : 4u;
    real one_two = left.one + right.two;
    real two_one = left.two + right.one;
    bool three = min(one_two, two_one) < cost.two;
    cost.three = three ? min(one_two, two_one) : cost.two;
    cost.split |= (three ? 48u : (two ? 32u : 16u)) | (one_two <= two_one ? 64u : 128u);
    return cost;
}

// Builds the hierarchy from the leaves up, as Apetrei 2014 ("Fast and simple agglomerative LBVH
// construction"), but with the node numbers of Karras 2012 (see LbvhNode): a node that covers
// first..last is the left child of the node split after `last`, or the right child of the node
// split before `first`, whichever splits leaves that are closer. The invocation that comes second
// to a parent has both its children and goes on with it.
FN void main() {
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
    vec3 low = vec3(boxes[2u * box]);
    vec3 high = vec3(boxes[2u * box + 1u]);
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
        // What follows is the right child of the node split after `last`: a leaf if its own split
        // is farther.
        uint escape = lbvh_end;
        if (after != no_neighbour) {
            uint next = last + 1u;
            uint beyond = distances[next];
            escape = 2u * next + (after < beyond ? 1u : 0u);
        }
        nodes[2u * place] = uvec4(float_bits(low), child);
        nodes[2u * place + 1u] = uvec4(float_bits(high), escape);
        if (for_rays && first != last) {
            costs[place >> 1u] =
                uvec4(float_bits(vec3(cost.one, cost.two, cost.three)), cost.split);
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
            MEMORY_FENCE(); // the node above is seen before its end is
            other = atomicExchange(ends[is_left ? last : first - 1u], is_left ? first : last);
        }
        going = other != lbvh_end;
        if (going) {
            MEMORY_FENCE(); // the sibling was written before its end was
            uint next = is_left ? last + 1u : first - 1u;
            uint sibling = 2u * next + (next == other ? 1u : 0u);
            vec3 sibling_low = bits_float(uvec3(nodes[2u * sibling]));
            vec3 sibling_high = bits_float(uvec3(nodes[2u * sibling + 1u]));
            if (for_rays) {
                ForestCost sibling_cost;
                sibling_cost.one = triangle_cost * half_area(sibling_low, sibling_high);
                sibling_cost.two = sibling_cost.three = sibling_cost.one;
                if (next != other) {
                    vec3 read = bits_float(uvec3(costs[next]));
                    sibling_cost = ForestCost(read.x, read.y, read.z, 0u);
                }
                real area = half_area(min(low, sibling_low), max(high, sibling_high));
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
