#include "shared/kernels/accel/finite_triangle.h"
#include "shared/kernels/accel/half_area.h"
#include "shared/kernels/accel/node_grid.h"

// A node or triangle that an invocation has fitted, and its cost: see traversal_cost().
struct Fitted {
    uint reference;
    vec3 low, high;
    real cost;
};

FN Fitted fit_triangle(uint leaf) {
    uint triangle = order[leaf];
    Corners t = finite_triangle(triangles[triangle]);
    leaf_triangles[3u * leaf] = vec4(t.a, bits_float(triangle));
    leaf_triangles[3u * leaf + 1u] = vec4(t.b, real(0.0));
    leaf_triangles[3u * leaf + 2u] = vec4(t.c, real(0.0));
    Fitted fitted;
    fitted.reference = 2u * leaf + 1u;
    fitted.low = min(min(t.a, t.b), t.c);
    fitted.high = max(max(t.a, t.b), t.c);
    fitted.cost = triangle_cost * half_area(fitted.low, fitted.high);
    return fitted;
}

// Fits a node whose children are all fitted.
FN Fitted fit_node(uint node, uint count) {
    uvec4 references = nodes[4u * node + 3u];
    Fitted fitted;
    fitted.reference = 2u * node;
    fitted.low = vec3(boxes[2u * references[0]]);
    fitted.high = vec3(boxes[2u * references[0] + 1u]);
    fitted.cost = boxes[2u * references[0]].w;
    for (uint i = 1u; i < count; ++i) {
        vec4 low = boxes[2u * references[i]];
        fitted.low = min(fitted.low, vec3(low));
        fitted.high = max(fitted.high, vec3(boxes[2u * references[i] + 1u]));
        fitted.cost += low.w;
    }
    fitted.cost += half_area(fitted.low, fitted.high);
    NodeGrid grid = grid_over(fitted.low, fitted.high);
    for (uint i = 0u; i < count; ++i) {
        add_child(grid, i, vec3(boxes[2u * references[i]]), vec3(boxes[2u * references[i] + 1u]));
    }
    write_grid(node, grid, count);
    return fitted;
}

// Fits the tree to its triangles from the leaves up. The last invocation to reach a node finds all
// its children fitted, and continues with the node.
FN void main() {
    uint leaf = THREAD_INDEX;
    if (leaf >= params.count.number) {
        return;
    }
    Fitted fitted = fit_triangle(leaf);
    bool going = true;
    while (going) {
        boxes[2u * fitted.reference] = vec4(fitted.low, fitted.cost);
        boxes[2u * fitted.reference + 1u] = vec4(fitted.high, real(0.0));
        uint parent = parents[fitted.reference];
        going = false;
        if (parent != lbvh_end) {
            uint node = parent >> 2u;
            uint count = nodes[4u * node].w >> 24u;
            MEMORY_FENCE(); // publish the box before the arrival
            going = atomicAdd(arrivals[node], 1u) + 1u == count;
            if (going) {
                MEMORY_FENCE(); // the other children were written before they arrived
                fitted = fit_node(node, count);
            }
        }
    }
}
