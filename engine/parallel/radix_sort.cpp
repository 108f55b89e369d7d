#include "parallel/radix_sort.hpp"

#include "device/primitives.hpp"
#include "kernels/sort_histogram_group.hpp"
#include "kernels/sort_histogram_serial.hpp"
#include "kernels/sort_keys_serial.hpp"
#include "kernels/sort_keys_shared.hpp"
#include "kernels/sort_keys_subgroup.hpp"
#include "kernels/sort_pairs64_serial.hpp"
#include "kernels/sort_pairs64_shared.hpp"
#include "kernels/sort_pairs64_subgroup.hpp"
#include "kernels/sort_pairs_serial.hpp"
#include "kernels/sort_pairs_shared.hpp"
#include "kernels/sort_pairs_subgroup.hpp"
#include "parallel/parts.hpp"
#include "parallel/scan.hpp"

#include <algorithm>
#include <utility>

namespace argand {

namespace {

/// The input or the output of a pass.
struct Elements {
    Buffer keys;
    Buffer values; ///< empty: keys only
};

PartsRecord sort_parts(Variant variant, const Count& count) {
    if (variant == Variant::serial) {
        // Enough lanes for 16 cores, but each with enough elements to outweigh its histogram.
        const std::uint64_t lanes = std::clamp<std::uint64_t>(count.bound / 8192, 16, 128);
        return {static_cast<uint>((lanes + 15) / 16 * 16), 16};
    }
    const std::uint64_t groups = std::clamp<std::uint64_t>(count.bound / (2 * sort_tile), 1, 512);
    return {static_cast<uint>(groups), sort_tile};
}

/// Sorts by the least significant digit first, in stable passes. A pass counts each part's digits,
/// turns the counts into places, and moves the elements there.
template <class Serial, class Subgroup, class Shared>
void sort(Device& device, const Elements& elements, const Count& count, std::uint32_t bits,
          std::uint32_t key_words) {
    check_room("sorting", elements.keys, count, key_words * sizeof(uint));
    if (elements.values) {
        check_room("sorting", elements.values, count, sizeof(uint));
    }
    if (count.bound < 2 || bits == 0) {
        return;
    }
    if (Primitives* primitives = device.primitives()) {
        primitives->sort(elements.keys, elements.values, count, bits, key_words);
        return;
    }
    const Variant variant = variant_of(device.info());
    const PartsRecord parts = sort_parts(variant, count);
    const Division division{count, variant, parts};
    const Buffer histograms =
        device.scratch("sort: histograms", std::uint64_t(parts.parts) * sort_digits * sizeof(uint));
    const std::uint64_t key_bytes = count.bound * key_words * sizeof(uint);
    const std::uint64_t value_bytes = elements.values ? count.bound * sizeof(uint) : 0;
    const Elements spare{device.scratch("sort: keys", key_bytes),
                         elements.values ? device.scratch("sort: values", value_bytes) : Buffer()};
    const std::uint32_t used_bits = std::min(bits, key_words * 32);
    const std::uint32_t passes = (used_bits + sort_digit_bits - 1) / sort_digit_bits;
    Elements from = elements;
    Elements to = spare;
    if (passes % 2 == 1) {
        // The last pass has to end in the caller's buffers, where words behind the last element
        // stay as they are.
        device.copy(BufferView(elements.keys, 0, key_bytes), spare.keys);
        if (elements.values) {
            device.copy(BufferView(elements.values, 0, value_bytes), spare.values);
        }
        std::swap(from, to);
    }
    for (std::uint32_t pass = 0; pass < passes; ++pass) {
        const std::uint32_t digit_bits =
            std::min(sort_digit_bits, used_bits - pass * sort_digit_bits);
        const SortParams params{.count = count_record(count),
                                .parts = parts,
                                .word = pass / 4,
                                .shift = pass % 4 * sort_digit_bits,
                                .digit_mask = (1u << digit_bits) - 1,
                                .key_words = key_words};
        for_variant<kernels::sort_histogram_serial, kernels::sort_histogram_group,
                    kernels::sort_histogram_group>(
            division, [&]<class Kernel>(std::uint64_t threads) {
                dispatch(device,
                         Kernel{.keys = from.keys,
                                .counts = counts_or(count, from.keys),
                                .histograms = histograms,
                                .params = params},
                         threads);
            });
        exclusive_scan(device, histograms, histograms, std::uint64_t(parts.parts) * sort_digits);
        for_variant<Serial, Subgroup, Shared>(division, [&]<class Kernel>(std::uint64_t threads) {
            Kernel kernel = [&] {
                if constexpr (requires(Kernel k) { k.values; }) {
                    return Kernel{.keys = from.keys,
                                  .counts = counts_or(count, from.keys),
                                  .offsets = histograms,
                                  .sorted_keys = to.keys,
                                  .values = from.values,
                                  .sorted_values = to.values,
                                  .params = params};
                } else {
                    return Kernel{.keys = from.keys,
                                  .counts = counts_or(count, from.keys),
                                  .offsets = histograms,
                                  .sorted_keys = to.keys,
                                  .params = params};
                }
            }();
            dispatch(device, kernel, threads);
        });
        std::swap(from, to);
    }
}

} // namespace

void radix_sort(Device& device, const Buffer& keys, const Count& count, std::uint32_t bits) {
    sort<kernels::sort_keys_serial, kernels::sort_keys_subgroup, kernels::sort_keys_shared>(
        device, {keys, {}}, count, bits, 1);
}

void radix_sort_pairs(Device& device, const Buffer& keys, const Buffer& values, const Count& count,
                      std::uint32_t bits) {
    sort<kernels::sort_pairs_serial, kernels::sort_pairs_subgroup, kernels::sort_pairs_shared>(
        device, {keys, values}, count, bits, 1);
}

void radix_sort_pairs64(Device& device, const Buffer& keys, const Buffer& values,
                        const Count& count, std::uint32_t bits) {
    sort<kernels::sort_pairs64_serial, kernels::sort_pairs64_subgroup,
         kernels::sort_pairs64_shared>(device, {keys, values}, count, bits, 2);
}

} // namespace argand
