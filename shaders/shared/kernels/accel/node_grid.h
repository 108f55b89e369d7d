// Biased exponent of the least power of two such that `cells` cells of that size cover the extent.
FN uint cell_exponent(real extent) {
    uint bits = float_bits(max(extent, real(0.0)) / real(255.0));
    return clamp((bits + 0x7fffffu) >> 23u, 1u, 254u);
}

// The grid of a RayNode, and its children's boxes rounded outwards to it.
struct NodeGrid {
    vec3 low, cell;
    uvec3 exponents, low_cells, high_cells;
};

FN NodeGrid grid_over(vec3 low, vec3 high) {
    NodeGrid grid;
    grid.low = low;
    grid.exponents = uvec3(cell_exponent(high.x - low.x), cell_exponent(high.y - low.y),
                           cell_exponent(high.z - low.z));
    grid.cell = bits_float(grid.exponents << 23u);
    grid.low_cells = uvec3(0u);
    grid.high_cells = uvec3(0u);
    return grid;
}

FN void add_child(INOUT(NodeGrid) grid, uint child, vec3 low, vec3 high) {
    vec3 first = floor((low - grid.low) / grid.cell);
    vec3 last = ceil((high - grid.low) / grid.cell);
    grid.low_cells |= uvec3(clamp(first, real(0.0), real(255.0))) << (8u * child);
    grid.high_cells |= uvec3(clamp(last, real(0.0), real(255.0))) << (8u * child);
}

// Writes all of a node but the references to its children.
FN void write_grid(uint node, NodeGrid grid, uint count) {
    nodes[4u * node] = uvec4(float_bits(grid.low), grid.exponents.x | (grid.exponents.y << 8u) |
                                                       (grid.exponents.z << 16u) | (count << 24u));
    nodes[4u * node + 1u] = uvec4(grid.low_cells, grid.high_cells.x);
    nodes[4u * node + 2u] = uvec4(grid.high_cells.y, grid.high_cells.z, 0u, 0u);
}
