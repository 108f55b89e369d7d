FN uint ancestor(uint source) { return params.first != 0u ? ancestors[source] : source; }

// Divides the queries of nodes among their parts. Notes of which node of the level each part is,
// and the first and last part of each node. params.first: whether nodes are parts already.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    uint source = sources[i];
    SegmentRange range = ranges[source];
    uint left_count = copies[source] == 2u ? lefts[source] : range.count;
    next_ranges[i] = i == parts[source]
                         ? SegmentRange(range.first, left_count)
                         : SegmentRange(range.first + left_count, range.count - left_count);
    uint node = ancestor(source);
    next_ancestors[i] = node;
    if (i == 0u || ancestor(sources[i - 1u]) != node) {
        families[2u * node] = i;
    }
    if (i + 1u == params.end || ancestor(sources[i + 1u]) != node) {
        families[2u * node + 1u] = i + 1u;
    }
}
