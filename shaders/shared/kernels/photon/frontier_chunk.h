// A chunk of a node's references, and the boxes of the node's children.
struct Chunk {
    uint node, children;
    uint first, end; // references
    uint at;         // of the first child's count
    uint stride;     // between counts of children: the node's chunks
    vec3 low[most_frontier_children];
    vec3 high[most_frontier_children];
};

FN Chunk make_chunk(uint i) {
    Chunk chunk;
    chunk.node = sources[i];
    FrontierNode node = nodes[chunk.node];
    uint k = i - first_chunks[chunk.node];
    uint first_child = families[2u * chunk.node];
    chunk.children = families[2u * chunk.node + 1u] - first_child;
    chunk.first = node.first + k * params.chunk;
    chunk.end = min(chunk.first + params.chunk, node.first + node.count);
    chunk.stride = chunks_of(node.count, params.chunk);
    chunk.at = most_frontier_children * first_chunks[chunk.node] + k;
    for (uint c = 0u; c < most_frontier_children; ++c) {
        chunk.low[c] = vec3(real(0.0));
        chunk.high[c] = vec3(real(0.0));
        if (c < chunk.children) {
            BoxRecord box = boxes[first_child + c];
            chunk.low[c] = box_low(box);
            chunk.high[c] = box_high(box);
        }
    }
    return chunk;
}

FN bool is_child(IN(Chunk) chunk, uint c) { return c < chunk.children; }

// params.first is the first photon of the batch.
FN vec3 extent_of(uvec4 reference) {
    return of_footprints ? vec3(extents[reference.w - params.first]) : vec3(params.reach);
}
