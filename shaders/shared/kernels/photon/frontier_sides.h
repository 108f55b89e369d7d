// Flags the queries that go to the first part of their node.
FN void main() {
    uint i = params.first + THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    uint node = segments[i];
    bool first = false;
    if (node != no_segment && copies[node] == 2u) {
        first = is_in_first_part(bits_float(uvec3(places[i])), boxes[node]);
    }
    flags[i] = first ? 1u : 0u;
}
