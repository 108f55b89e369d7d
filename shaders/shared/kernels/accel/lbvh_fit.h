#include "shared/kernels/accel/half_area.h"
#include "shared/kernels/count.h"

// Costs of an inner node from those of its children (Ylitie et al. 2017, section 4).
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

// A node with its subtree, from which an invocation climbs towards the root.
struct Subtree {
    uint first, last;   // its leaves
    uint before, after; // distances of the codes at its ends from their neighbours outside
    uint place;         // index of its root among the nodes
    uint child;         // the left child, or the box of a leaf
    uint right_child;   // 0 for a leaf
    vec3 low, high;
    ForestCost cost; // only for rays
};

FN Subtree leaf_subtree(uint leaf) {
    Subtree tree;
    tree.first = leaf;
    tree.last = leaf;
    tree.before = leaf > 0u ? distances[leaf - 1u] : no_neighbour;
    tree.after = distances[leaf];
    tree.place = 2u * leaf + 1u;
    tree.child = order[leaf];
    tree.right_child = 0u;
    uint box = in_order ? leaf : tree.child;
    tree.low = vec3(boxes[2u * box]);
    tree.high = vec3(boxes[2u * box + 1u]);
    tree.cost.one = tree.cost.two = tree.cost.three =
        triangle_cost * half_area(tree.low, tree.high);
    tree.cost.split = 0u;
    return tree;
}

FN void write_node(Subtree tree) {
    // Escape to the right child of the node split after `last`: a leaf if its own split is farther.
    uint escape = lbvh_end;
    if (tree.after != no_neighbour) {
        uint next = tree.last + 1u;
        uint beyond = distances[next];
        escape = 2u * next + (tree.after < beyond ? 1u : 0u);
    }
    nodes[2u * tree.place] = uvec4(float_bits(tree.low), tree.child);
    nodes[2u * tree.place + 1u] = uvec4(float_bits(tree.high), escape);
}

// Writes the costs of an inner node, and the node as the parent of its children.
FN void write_cost_and_parents(Subtree tree, bool root) {
    costs[tree.place >> 1u] =
        uvec4(float_bits(vec3(tree.cost.one, tree.cost.two, tree.cost.three)), tree.cost.split);
    if (root) {
        parents[0] = lbvh_end;
    }
    if ((tree.child & 1u) == 0u) {
        parents[tree.child >> 1u] = tree.place;
    }
    if ((tree.right_child & 1u) == 0u) {
        parents[tree.right_child >> 1u] = tree.place + 1u;
    }
}

// Costs of a node that another invocation wrote. leaf: whether the node is a leaf.
FN ForestCost written_cost(uint place, bool leaf, vec3 low, vec3 high) {
    ForestCost cost;
    cost.one = triangle_cost * half_area(low, high);
    cost.two = cost.three = cost.one;
    cost.split = 0u;
    if (!leaf) {
        vec3 read = bits_float(uvec3(costs[place]));
        cost = ForestCost(read.x, read.y, read.z, 0u);
    }
    return cost;
}

// Replaces the subtree by its parent's. other: the end of the sibling's leaves that is farther
// away.
FN void join_sibling(INOUT(Subtree) tree, uint other, bool is_left) {
    uint next = is_left ? tree.last + 1u : tree.first - 1u;
    uint sibling = 2u * next + (next == other ? 1u : 0u);
    vec3 low = bits_float(uvec3(nodes[2u * sibling]));
    vec3 high = bits_float(uvec3(nodes[2u * sibling + 1u]));
    if (for_rays) {
        ForestCost cost = written_cost(next, next == other, low, high);
        real area = half_area(min(tree.low, low), max(tree.high, high));
        if (is_left) {
            tree.cost = join(tree.cost, cost, area);
        } else {
            tree.cost = join(cost, tree.cost, area);
        }
    }
    tree.low = min(tree.low, low);
    tree.high = max(tree.high, high);
    tree.child = is_left ? tree.place : sibling;
    tree.right_child = is_left ? sibling : tree.place;
    if (is_left) {
        tree.last = other;
        tree.after = distances[tree.last];
    } else {
        tree.first = other;
        tree.before = tree.first > 0u ? distances[tree.first - 1u] : no_neighbour;
    }
}

// Builds the hierarchy from the leaves up like Apetrei 2014 ("Fast and simple agglomerative LBVH
// construction"), but with the node numbers of Karras 2012 (see LbvhNode). A node that covers
// first..last is the left child of the node split after `last` or the right child of the node split
// before `first`, whichever splits closer leaves. The second invocation to reach a parent has both
// children and continues with the parent.
FN void main() {
    uint leaf = THREAD_INDEX;
    if (leaf >= ELEMENT_COUNT) {
        return;
    }
    Subtree tree = leaf_subtree(leaf);
    bool going = true;
    while (going) {
        bool root = tree.before == no_neighbour && tree.after == no_neighbour;
        bool is_left = tree.after < tree.before;
        bool inner = tree.first != tree.last;
        if (inner) {
            tree.place = root ? 0u : 2u * (is_left ? tree.last : tree.first);
        }
        write_node(tree);
        if (for_rays && inner) {
            write_cost_and_parents(tree, root);
        }
        uint other = lbvh_end;
        if (!root) {
            MEMORY_FENCE(); // publish the node before its end
            other = atomicExchange(ends[is_left ? tree.last : tree.first - 1u],
                                   is_left ? tree.first : tree.last);
        }
        going = other != lbvh_end;
        if (going) {
            MEMORY_FENCE(); // the sibling was written before its end
            join_sibling(tree, other, is_left);
        }
    }
}
