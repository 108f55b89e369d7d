#ifndef ARGAND_SHARED_SEGMENTS_H
#define ARGAND_SHARED_SEGMENTS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Of an element that belongs to no segment.
CONSTANT uint no_segment = 0xffffffffu;

// Elements that one invocation takes in a reduction of segments.
CONSTANT uint segment_run = 64u;

// Elements `first` <= i < `end`.
struct SegmentRangeParams {
    uint first, end;
    uint pad0, pad1;
};

// Elements of a segment: `count` from `first` on.
struct SegmentRange {
    uint first, count;
};

// Copies of elements, as many as counts say.
struct ExpandParams {
    uint elements; // at least 1
    uint copies;
    uint pad0, pad1;
};

// Words of floats whose order as unsigned integers is that of the floats.
FN uint ordered_word(float32 x) {
    uint bits = float_bits(x);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
FN float32 from_ordered_word(uint word) {
    return bits_float((word & 0x80000000u) != 0u ? word & 0x7fffffffu : ~word);
}

// The place to which element i of a segment goes that begins at `first`: those that are flagged
// come first, in their order; `lefts` of them are in the segment, `before` of them before i.
FN uint partition_place(uint i, uint first, uint lefts, uint before, bool is_left) {
    return is_left ? first + before : first + lefts + (i - first - before);
}

ARGAND_SHARED_END

#endif
