// Reads the boxes that queue_box.h lets grow.
FN real number_of(uint ordered) {
    return bits_float((ordered & 0x80000000u) != 0u ? ordered & 0x7fffffffu : ~ordered);
}

FN vec3 low_corner(uint cell) {
    uint first = 6u * cell;
    return vec3(number_of(boxes[first]), number_of(boxes[first + 1u]),
                number_of(boxes[first + 2u]));
}

FN vec3 high_corner(uint cell) {
    uint first = 6u * cell + 3u;
    return -vec3(number_of(boxes[first]), number_of(boxes[first + 1u]),
                 number_of(boxes[first + 2u]));
}

FN bool is_untouched(uint cell) { return boxes[6u * cell] == 0xffffffffu; }
