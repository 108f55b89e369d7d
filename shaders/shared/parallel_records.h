#ifndef ARGAND_SHARED_PARALLEL_RECORDS_H
#define ARGAND_SHARED_PARALLEL_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// A number of elements: `number`, or, if on_device is not 0, the uint at `index` of a buffer, at
// most `number`.
struct CountRecord {
    uint number;
    uint index;
    uint on_device;
};

// The elements are divided into `parts` contiguous parts of part_size() elements; trailing parts
// may be short or empty. One work-group processes a part; on devices that run lanes serially, one
// lane does.
struct PartsRecord {
    uint parts;
    uint grain; // in elements; the size of a part is a multiple of it
};

// Elements per part. The number of grains is odd because parts that start at multiples of a power
// of two would compete for the same few sets of a CPU's cache.
FN uint part_size(uint count, PartsRecord parts) {
    uint spread = parts.parts * parts.grain;
    uint grains = count / spread + (count % spread > 0u ? 1u : 0u);
    return (grains | 1u) * parts.grain;
}

CONSTANT uint reduce_op_sum = 0u;
CONSTANT uint reduce_op_min = 1u;
CONSTANT uint reduce_op_max = 2u;
CONSTANT uint reduce_op_count = 3u; // elements that are not 0

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
// Elements that a work-group of 128 sorts at a time. An odd number per lane avoids conflicts
// between banks of shared memory.
CONSTANT uint sort_items = 15u;
CONSTANT uint sort_tile = 1920u;

// One pass of the radix sort: by the digit at `shift` of word `word`, in keys of `key_words` words.
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
