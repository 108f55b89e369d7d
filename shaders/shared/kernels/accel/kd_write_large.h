// Writes the elements of leaves with more than kd_small of them.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end || finished_nodes[i] == no_segment) {
        return;
    }
    uint node = finished_nodes[i];
    words[places[node].address + kd_leaf_words + (i - nodes[node].first)] = finished[i];
}
