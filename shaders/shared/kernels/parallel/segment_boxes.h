// Grows a segment's box. The words of the upper corner are complements, so that both corners
// shrink.
FN void grow_segment(uint segment, vec3 low, vec3 high) {
    uint at = 8u * segment;
    atomicMin(box_words[at], ordered_word(low.x));
    atomicMin(box_words[at + 1u], ordered_word(low.y));
    atomicMin(box_words[at + 2u], ordered_word(low.z));
    atomicMin(box_words[at + 4u], ~ordered_word(high.x));
    atomicMin(box_words[at + 5u], ~ordered_word(high.y));
    atomicMin(box_words[at + 6u], ~ordered_word(high.z));
}

// Reduces a run of elements, and adds it to a box wherever a segment ends. Minima do not depend on
// the order in which the runs arrive.
FN void main() {
    uint i = params.first + THREAD_INDEX * segment_run;
    uint end = min(i + segment_run, params.end);
    uint segment = no_segment;
    vec3 low = vec3(real(0.0));
    vec3 high = vec3(real(0.0));
    for (; i < end; ++i) {
        bool begins = segments[i] != segment;
        if (begins && segment != no_segment) {
            grow_segment(segment, low, high);
        }
        segment = segments[i];
        if (segment == no_segment) {
            continue; // the element may never have been written
        }
        vec3 element_low = bits_float(uvec3(elements[lanes * i]));
        vec3 element_high = bits_float(uvec3(elements[lanes * i + lanes - 1u]));
        low = begins ? element_low : min(low, element_low);
        high = begins ? element_high : max(high, element_high);
    }
    if (segment != no_segment) {
        grow_segment(segment, low, high);
    }
}
