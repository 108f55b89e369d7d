// Body of the sort's kernels that work on a part with a group. Each tile of a part is sorted by the
// digit in shared memory, in two rounds of four bits (after Satish, Harris and Garland 2009,
// "Designing efficient sorting algorithms for manycore GPUs"), so that runs of equal digits are
// written together. VALUES: with values; KEYS64: keys of two words.
#include "parallel/group_scan.glsl"
layout(local_size_x = GROUP_SIZE) in;
#include "shared/parallel_records.h"

layout(set = 0, binding = 0) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 2) readonly buffer Offsets { uint offsets[]; };
layout(set = 0, binding = 3) writeonly buffer SortedKeys { uint sorted_keys[]; };
#ifdef VALUES
layout(set = 0, binding = 4) readonly buffer Values { uint values[]; };
layout(set = 0, binding = 5) writeonly buffer SortedValues { uint sorted_values[]; };
#endif
layout(push_constant) uniform Push { SortParams params; };
#include "parallel/parts.glsl"

#define ITEMS sort_items
#define TILE sort_tile
#define ROUND_DIGITS 16u
#define ROWS (ROUND_DIGITS / 2u)

shared uint exchange[TILE];
// Two counters of 16 bits in each word, for each lane: that of digit d is in row d % ROWS, half
// d / ROWS.
shared uint counters[ROWS * GROUP_SIZE];
shared uint next[sort_digits];      // destination of the part's next element with each digit
shared uint first[sort_digits];     // begin of each digit's run in the sorted tile

uint digit_of(uint word) { return (word >> params.shift) & params.digit_mask; }

// Element i of a tile is either item i % ITEMS of lane i / ITEMS ("blocked", for ranking in order)
// or item i / GROUP_SIZE of lane i % GROUP_SIZE ("striped", for coalesced access).
uint striped(uint item, uint lane) { return item * GROUP_SIZE + lane; }
uint blocked(uint item, uint lane) { return item + lane * ITEMS; }

// Turns the counters into exclusive sums over (digit, lane). It adds both halves of a word at once:
// a tile has fewer than 2^16 elements.
void scan_counters(uint lane) {
    uint words[ROWS];
    uint sum = 0u;
    for (uint k = 0u; k < ROWS; ++k) {
        words[k] = counters[lane * ROWS + k];
        sum += words[k];
    }
    uint total;
    uint before = group_exclusive_sum(sum, total);
    before += total << 16u;     // digits in the high halves come after all in the low halves
    for (uint k = 0u; k < ROWS; ++k) {
        counters[lane * ROWS + k] = before;
        before += words[k];
    }
}

// Ranks the lane's blocked items by four bits of their digits; stable.
void rank_items(uint words[ITEMS], uint round, uint lane, out uint ranks[ITEMS]) {
    barrier();
    for (uint row = 0u; row < ROWS; ++row) {
        counters[row * GROUP_SIZE + lane] = 0u;
    }
    for (uint k = 0u; k < ITEMS; ++k) {
        uint digit = digit_of(words[k]) >> 4u * round & (ROUND_DIGITS - 1u);
        uint at = digit % ROWS * GROUP_SIZE + lane;
        uint half_shift = digit / ROWS * 16u;
        ranks[k] = (counters[at] >> half_shift) & 0xffffu;
        counters[at] += 1u << half_shift;
    }
    barrier();
    scan_counters(lane);
    barrier();
    for (uint k = 0u; k < ITEMS; ++k) {
        uint digit = digit_of(words[k]) >> 4u * round & (ROUND_DIGITS - 1u);
        uint half_shift = digit / ROWS * 16u;
        ranks[k] += (counters[digit % ROWS * GROUP_SIZE + lane] >> half_shift) & 0xffffu;
    }
}

// Moves each item to its rank and returns the lane's items at their new places.
void exchange_items(inout uint words[ITEMS], uint ranks[ITEMS], uint lane, bool to_striped) {
    barrier();
    for (uint k = 0u; k < ITEMS; ++k) {
        exchange[ranks[k]] = words[k];
    }
    barrier();
    for (uint k = 0u; k < ITEMS; ++k) {
        words[k] = exchange[to_striped ? striped(k, lane) : blocked(k, lane)];
    }
}

// From striped to blocked items.
void block_items(inout uint words[ITEMS], uint lane) {
    barrier();
    for (uint k = 0u; k < ITEMS; ++k) {
        exchange[striped(k, lane)] = words[k];
    }
    barrier();
    for (uint k = 0u; k < ITEMS; ++k) {
        words[k] = exchange[blocked(k, lane)];
    }
}

void sort_tile_at(uint tile, uint here, uint lane) {
    // Places behind the last element get the last digit. The sort is stable, so they stay behind
    // all others.
    uint words[ITEMS];
#ifdef KEYS64
    uint others[ITEMS];
#endif
#ifdef VALUES
    uint items[ITEMS];
#endif
    for (uint k = 0u; k < ITEMS; ++k) {
        uint i = striped(k, lane);
#ifdef KEYS64
        words[k] = i < here ? keys[2u * (tile + i) + params.word] : 0xffffffffu;
        others[k] = i < here ? keys[2u * (tile + i) + 1u - params.word] : 0u;
#else
        words[k] = i < here ? keys[tile + i] : 0xffffffffu;
#endif
#ifdef VALUES
        items[k] = i < here ? values[tile + i] : 0u;
#endif
    }
    block_items(words, lane);
#ifdef KEYS64
    block_items(others, lane);
#endif
#ifdef VALUES
    block_items(items, lane);
#endif

    uint ranks[ITEMS];
    for (uint round = 0u; round < 2u; ++round) {
        bool last = round == 1u;
        rank_items(words, round, lane, ranks);
#ifdef VALUES
        exchange_items(items, ranks, lane, last);
#endif
#ifdef KEYS64
        exchange_items(others, ranks, lane, last);
#endif
        exchange_items(words, ranks, lane, last);
    }

    // `exchange` still holds the sorted words: runs begin and end where neighbours differ.
    for (uint k = 0u; k < ITEMS; ++k) {
        uint i = striped(k, lane);
        if (i == 0u || digit_of(exchange[i - 1u]) != digit_of(words[k])) {
            first[digit_of(words[k])] = i;
        }
    }
    barrier();
    for (uint k = 0u; k < ITEMS; ++k) {
        uint i = striped(k, lane);
        uint digit = digit_of(words[k]);
        ranks[k] = next[digit] + i - first[digit];      // from here on: the element's destination
        if (i < here) {
#ifdef KEYS64
            sorted_keys[2u * ranks[k] + params.word] = words[k];
            sorted_keys[2u * ranks[k] + 1u - params.word] = others[k];
#else
            sorted_keys[ranks[k]] = words[k];
#endif
#ifdef VALUES
            sorted_values[ranks[k]] = items[k];
#endif
        }
    }
    barrier();
    for (uint k = 0u; k < ITEMS; ++k) {
        uint i = striped(k, lane);
        uint digit = digit_of(words[k]);
        if (i < here && (i + 1u == here || digit_of(exchange[i + 1u]) != digit)) {
            next[digit] = ranks[k] + 1u;
        }
    }
}

// One part per group.
void main() {
    uint lane = scan_order();
    uint part = GROUP_INDEX;
    uvec2 range = part_range(part, element_count());
    for (uint digit = lane; digit < sort_digits; digit += GROUP_SIZE) {
        next[digit] = part < params.parts.parts ? offsets[digit * params.parts.parts + part] : 0u;
    }
    for (uint tile = range.x; tile < range.y; tile += TILE) {
        sort_tile_at(tile, min(range.y - tile, TILE), lane);
    }
}
