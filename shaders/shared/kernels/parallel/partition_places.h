// Finds the places of a stable two-way partition. Sums over all elements serve every segment, as
// the sums of a segment are differences.
FN void main() {
    uint i = params.first + THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    uint segment = segments[i];
    if (segment == no_segment) {
        places[i] = i;
        return;
    }
    SegmentRange range = ranges[segment];
    uint last = range.first + range.count - 1u;
    uint start = sums[range.first];
    uint left_count = sums[last] + flags[last] - start;
    places[i] = partition_place(i, range.first, left_count, sums[i] - start, flags[i] != 0u);
    if (i == range.first) {
        lefts[segment] = left_count;
    }
}
