#include "device/host/host_primitives.hpp"

#include "device/host/host_device.hpp"
#include "shared/geometry_records.h"
#include "shared/parallel_records.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#ifdef __GLIBCXX__
#include <parallel/algorithm>
#endif

namespace argand::host {

namespace {

template <class T> std::span<T> elements(const Buffer& buffer, std::uint64_t count) {
    return {reinterpret_cast<T*>(block_of<HostBlock>(buffer).data), count};
}

std::uint64_t number_of(const Count& count) {
    return count.on_device()
               ? std::min<std::uint64_t>(elements<uint>(count.buffer, count.index + 1)[count.index],
                                         count.bound)
               : count.bound;
}

template <class Elements, class Less> void stable_sort(Elements& elements, Less less) {
#ifdef __GLIBCXX__
    __gnu_parallel::stable_sort(elements.begin(), elements.end(), less);
#else
    std::stable_sort(elements.begin(), elements.end(), less);
#endif
}

/// Sorts by the masked bits of the keys.
template <class Key> void sort_pairs(std::span<Key> keys, std::span<uint> values, Key mask) {
    struct Pair {
        Key key;
        uint value;
    };
    std::vector<Pair> pairs(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        pairs[i] = {keys[i], values[i]};
    }
    stable_sort(pairs,
                [mask](const Pair& a, const Pair& b) { return (a.key & mask) < (b.key & mask); });
    for (std::size_t i = 0; i < keys.size(); ++i) {
        keys[i] = pairs[i].key;
        values[i] = pairs[i].value;
    }
}

template <class Key> Key lowest_bits(std::uint32_t bits) {
    constexpr std::uint32_t all = std::numeric_limits<Key>::digits;
    return bits >= all ? std::numeric_limits<Key>::max() : static_cast<Key>((Key(1) << bits) - 1);
}

} // namespace

void HostPrimitives::sort(const Buffer& keys, const Buffer& values, const Count& count,
                          std::uint32_t bits, std::uint32_t key_words) {
    const std::uint64_t n = number_of(count);
    if (key_words == 2) {
        // The low word comes first: on the little-endian hosts that Vulkan supports, both words are
        // one 64-bit integer.
        sort_pairs(elements<std::uint64_t>(keys, n), elements<uint>(values, n),
                   lowest_bits<std::uint64_t>(bits));
    } else if (values) {
        sort_pairs(elements<uint>(keys, n), elements<uint>(values, n), lowest_bits<uint>(bits));
    } else {
        std::span<uint> all = elements<uint>(keys, n);
        stable_sort(all, [mask = lowest_bits<uint>(bits)](uint a, uint b) {
            return (a & mask) < (b & mask);
        });
    }
}

void HostPrimitives::scan(const Buffer& in, const Buffer& out, const Count& count, bool inclusive) {
    const std::span<const uint> from = elements<const uint>(in, number_of(count));
    const std::span<uint> to = elements<uint>(out, from.size());
    if (inclusive) {
        std::inclusive_scan(from.begin(), from.end(), to.begin());
    } else {
        std::exclusive_scan(from.begin(), from.end(), to.begin(), 0u);
    }
}

void HostPrimitives::segmented_scan(const Buffer& in, const Buffer& heads, const Buffer& out,
                                    const Count& count) {
    const std::span<const uint> from = elements<const uint>(in, number_of(count));
    const std::span<const uint> head = elements<const uint>(heads, from.size());
    const std::span<uint> to = elements<uint>(out, from.size());
    uint sum = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        sum = (head[i] != 0 ? 0 : sum) + from[i];
        to[i] = sum;
    }
}

void HostPrimitives::reduce(const Buffer& in, const Buffer& out, std::uint32_t out_index,
                            const Count& count, std::uint32_t op) {
    const std::span<const uint> from = elements<const uint>(in, number_of(count));
    uint result = 0;
    switch (op) {
    case reduce_op_min:
        result = from.empty() ? 0xffffffffu : *std::min_element(from.begin(), from.end());
        break;
    case reduce_op_max:
        result = from.empty() ? 0u : *std::max_element(from.begin(), from.end());
        break;
    default:
        result = std::accumulate(from.begin(), from.end(), 0u);
    }
    elements<uint>(out, out_index + 1)[out_index] = result;
}

void HostPrimitives::reduce_box(const Buffer& boxes, const Buffer& out, std::uint32_t out_index,
                                const Count& count) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    BoxRecord all{infinity, infinity, infinity, 0, -infinity, -infinity, -infinity, 0};
    for (const BoxRecord& box : elements<const BoxRecord>(boxes, number_of(count))) {
        all.low_x = std::min(all.low_x, box.low_x);
        all.low_y = std::min(all.low_y, box.low_y);
        all.low_z = std::min(all.low_z, box.low_z);
        all.high_x = std::max(all.high_x, box.high_x);
        all.high_y = std::max(all.high_y, box.high_y);
        all.high_z = std::max(all.high_z, box.high_z);
    }
    elements<BoxRecord>(out, out_index + 1)[out_index] = all;
}

void HostPrimitives::compact(const Buffer& flags, const Buffer& values, const Buffer& out,
                             const Buffer& counts, std::uint32_t count_index, const Count& count) {
    const std::uint64_t n = number_of(count);
    const std::span<const uint> flag = elements<const uint>(flags, n);
    const std::span<const uint> from = elements<const uint>(values, n);
    const std::span<uint> to = elements<uint>(out, n);
    uint kept = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (flag[i] != 0) {
            to[kept++] = from[i];
        }
    }
    elements<uint>(counts, count_index + 1)[count_index] = kept;
}

} // namespace argand::host
