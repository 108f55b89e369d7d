#pragma once

#include "device/count.hpp"

#include <cstdint>

namespace argand {

/// Sort, scan, reduce and compact by a backend's own libraries instead of Argand's kernels.
/// parallel/ documents what each does. Integer results are equal to the bit.
class Primitives {
public:
    Primitives() = default;
    Primitives(const Primitives&) = delete;
    Primitives& operator=(const Primitives&) = delete;
    virtual ~Primitives() = default;

    /// Sorts keys of one or two words (low, high). Each value moves with its key; `values` may be
    /// empty.
    virtual void sort(const Buffer& keys, const Buffer& values, const Count& count,
                      std::uint32_t bits, std::uint32_t key_words) = 0;
    virtual void scan(const Buffer& in, const Buffer& out, const Count& count, bool inclusive) = 0;
    virtual void segmented_scan(const Buffer& in, const Buffer& heads, const Buffer& out,
                                const Count& count) = 0;
    /// `op`: reduce_op_sum, reduce_op_min or reduce_op_max of shared/parallel_records.h.
    virtual void reduce(const Buffer& in, const Buffer& out, std::uint32_t out_index,
                        const Count& count, std::uint32_t op) = 0;
    virtual void reduce_box(const Buffer& boxes, const Buffer& out, std::uint32_t out_index,
                            const Count& count) = 0;
    virtual void compact(const Buffer& flags, const Buffer& values, const Buffer& out,
                         const Buffer& counts, std::uint32_t count_index, const Count& count) = 0;
};

} // namespace argand
