// Counts the references of a chunk that go to each child. Counts lie in the order of the nodes, of
// a node's children, and of its chunks, so that their sums are the places of the copies.
#include "shared/kernels/photon/frontier_chunk.h"

FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    Chunk chunk = make_chunk(i);
    uint found[most_frontier_children];
    for (uint c = 0u; c < most_frontier_children; ++c) {
        found[c] = 0u;
    }
    for (uint j = chunk.first; j < chunk.end; ++j) {
        uvec4 reference = references[j];
        vec3 p = bits_float(uvec3(reference));
        vec3 extent = extent_of(reference);
        for (uint c = 0u; c < most_frontier_children; ++c) {
            found[c] +=
                is_child(chunk, c) && reaches(p, extent, chunk.low[c], chunk.high[c]) ? 1u : 0u;
        }
    }
    for (uint c = 0u; c < most_frontier_children; ++c) {
        counts[chunk.at + c * chunk.stride] = found[c];
    }
}
