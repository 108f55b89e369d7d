// Boxes of cells that grow, of six words each: the low corner, and the negative of the high one,
// as words whose order is that of the numbers.
FN uint ordered_bits(real x) {
    uint bits = float_bits(x);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

FN void grow_to(uint word, uint to) {
    if (to < boxes[word]) {
        atomicMin(boxes[word], to);
    }
}

FN void grow(uint cell, vec3 low, vec3 high) {
    uint first = 6u * cell;
    grow_to(first, ordered_bits(low.x));
    grow_to(first + 1u, ordered_bits(low.y));
    grow_to(first + 2u, ordered_bits(low.z));
    grow_to(first + 3u, ordered_bits(-high.x));
    grow_to(first + 4u, ordered_bits(-high.y));
    grow_to(first + 5u, ordered_bits(-high.z));
}
