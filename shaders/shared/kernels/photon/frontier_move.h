// Moves queries to the parts of their node. Those of a node without parts are in none any more.
FN void main() {
    uint i = params.first + THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    uint node = segments[i];
    if (node == no_segment || copies[node] == 0u) {
        next_segments[i] = no_segment;
        return;
    }
    next_places[to[i]] = places[i];
    next_segments[to[i]] = parts[node] + (copies[node] == 2u ? 1u - flags[i] : 0u);
}
