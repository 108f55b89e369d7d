// Copies the references of a chunk to the children that their photons may reach.
#include "shared/kernels/photon/frontier_chunk.h"

FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    Chunk chunk = make_chunk(i);
    uint to[most_frontier_children];
    for (uint c = 0u; c < most_frontier_children; ++c) {
        to[c] = places[chunk.at + c * chunk.stride];
    }
    for (uint j = chunk.first; j < chunk.end; ++j) {
        uvec4 reference = references[j];
        vec3 p = bits_float(uvec3(reference));
        vec3 extent = extent_of(reference);
        for (uint c = 0u; c < most_frontier_children; ++c) {
            if (is_child(chunk, c) && reaches(p, extent, chunk.low[c], chunk.high[c])) {
                next_references[to[c]] = reference;
                to[c] += 1u;
            }
        }
    }
}
