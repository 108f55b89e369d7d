#ifndef ARGAND_SHARED_PARALLEL_RECORDS_H
#define ARGAND_SHARED_PARALLEL_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// How many elements there are: `number`, or where `on_device` is not 0 the uint at `index` of a
// buffer, but at most `number`.
struct CountRecord {
    uint number;
    uint index;
    uint on_device;
};

// The elements fall into `parts` contiguous parts of part_size() elements; trailing parts may be
// short or empty. A part is worked on by one work-group, or on devices that run lanes serially by
// one lane.
struct PartsRecord {
    uint parts;
    uint grain; // elements; a part's size is a multiple of it
};

// Elements per part. The number of grains is odd: parts that start at multiples of a power of two
// would compete for the same few sets of a CPU's cache.
FN uint part_size(uint count, PartsRecord parts) {
    uint spread = parts.parts * parts.grain;
    uint grains = count / spread + (count % spread > 0u ? 1u : 0u);
    return (grains | 1u) * parts.grain;
}

CONSTANT uint reduce_op_sum = 0u;
CONSTANT uint reduce_op_min = 1u;
CONSTANT uint reduce_op_max = 2u;
CONSTANT uint reduce_op_count = 3u; // of the elements that are not 0

struct ReduceParams {
    CountRecord count;
    PartsRecord parts;
    uint op;
    uint first_out;
};

struct ReduceBoxParams {
    CountRecord count;
    PartsRecord parts;
    uint first_out;
};

struct ScanParams {
    CountRecord count;
    PartsRecord parts;
    uint inclusive;
};

struct SegmentParams {
    CountRecord count;
    PartsRecord parts;
};

struct CompactParams {
    CountRecord count;
    PartsRecord parts;
    uint total_index;
};

CONSTANT uint sort_digit_bits = 8u;
CONSTANT uint sort_digits = 256u;
// Elements that a group of 128 sorts at a time: an odd number per lane, for banks of shared memory.
CONSTANT uint sort_items = 15u;
CONSTANT uint sort_tile = 1920u;

// One pass of the radix sort: by the digit at `shift` of word `word` of keys of `key_words` words.
struct SortParams {
    CountRecord count;
    PartsRecord parts;
    uint word;
    uint shift;
    uint digit_mask;
    uint key_words;
};

ARGAND_SHARED_END

#endif
