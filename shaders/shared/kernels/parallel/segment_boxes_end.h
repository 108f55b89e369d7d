// Turns the words of segment_boxes into a box (BoxRecord); low > high for a segment without
// elements.
FN void main() {
    uint i = params.first + THREAD_INDEX;
    if (i >= params.end) {
        return;
    }
    for (uint k = 0u; k < 3u; ++k) {
        uint low = box_words[8u * i + k];
        uint high = box_words[8u * i + 4u + k];
        bool empty = low == no_segment;
        box_words[8u * i + k] = float_bits(empty ? real(3.0e38) : from_ordered_word(low));
        box_words[8u * i + 4u + k] = float_bits(empty ? -real(3.0e38) : from_ordered_word(~high));
    }
    box_words[8u * i + 3u] = 0u;
    box_words[8u * i + 7u] = 0u;
}
