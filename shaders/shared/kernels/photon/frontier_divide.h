// The parts of a level's nodes and the chunks of their references: none if a node is not active, or
// not between params.first and params.end.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    bool is_active = i >= params.first && nodes[i].state == frontier_active;
    copies[i] = is_active ? 2u : 0u;
    chunks[i] = is_active ? chunks_of(nodes[i].count, params.chunk) : 0u;
}
