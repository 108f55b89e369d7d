#pragma once

#include "device/primitives.hpp"

namespace argand::host {

/// Implements the primitives by the standard library's algorithms, in libstdc++'s parallel mode
/// where available.
class HostPrimitives final : public Primitives {
public:
    void sort(const Buffer& keys, const Buffer& values, const Count& count, std::uint32_t bits,
              std::uint32_t key_words) override;
    void scan(const Buffer& in, const Buffer& out, const Count& count, bool inclusive) override;
    void segmented_scan(const Buffer& in, const Buffer& heads, const Buffer& out,
                        const Count& count) override;
    void reduce(const Buffer& in, const Buffer& out, std::uint32_t out_index, const Count& count,
                std::uint32_t op) override;
    void reduce_box(const Buffer& boxes, const Buffer& out, std::uint32_t out_index,
                    const Count& count) override;
    void compact(const Buffer& flags, const Buffer& values, const Buffer& out, const Buffer& counts,
                 std::uint32_t count_index, const Count& count) override;
};

} // namespace argand::host
