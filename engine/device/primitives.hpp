#pragma once

#include "device/count.hpp"

#include <cstdint>

namespace argand {

/// Sort, scan, reduce and compact as a backend's own libraries do them, in place of Argand's
/// kernels; what each does is said where parallel/ offers it. Integers come out the same to the
/// bit.
class Primitives {
public:
    Primitives() = default;
    Primitives(const Primitives&) = delete;
    Primitives& operator=(const Primitives&) = delete;
    virtual ~Primitives() = default;

    /// Keys of one or two words (low, high), with a word beside each or, if `values` is empty,
    /// without.
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
