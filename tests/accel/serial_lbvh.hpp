#pragma once

#include "shared/accel_records.h"
#include "shared/geometry_records.h"
#include "shared/morton.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <vector>

namespace argand {

struct SerialLbvh {
    std::vector<std::uint32_t> order;
    std::vector<LbvhNode> nodes;
};

inline BoxRecord box_union(const BoxRecord& a, const BoxRecord& b) {
    return {std::min(a.low_x, b.low_x),   std::min(a.low_y, b.low_y),
            std::min(a.low_z, b.low_z),   0,
            std::max(a.high_x, b.high_x), std::max(a.high_y, b.high_y),
            std::max(a.high_z, b.high_z), 0};
}

/// The tree that build_lbvh builds, from the root down: a range of leaves is split where the
/// highest bit differs in which the codes of its ends do, or their places if the codes are equal.
class SerialBuild {
public:
    explicit SerialBuild(const std::vector<BoxRecord>& boxes) : boxes_(boxes) {
        const std::size_t count = boxes.size();
        BoxRecord all = boxes.empty() ? BoxRecord{} : boxes[0];
        for (const BoxRecord& box : boxes) {
            all = box_union(all, box);
        }
        std::vector<std::uint32_t> codes(count);
        for (std::size_t i = 0; i < count; ++i) {
            const BoxRecord& box = boxes[i];
            const vec3 centre = 0.5f * vec3(box.low_x, box.low_y, box.low_z) +
                                0.5f * vec3(box.high_x, box.high_y, box.high_z);
            codes[i] = morton30(centre, vec3(all.low_x, all.low_y, all.low_z),
                                vec3(all.high_x, all.high_y, all.high_z));
        }
        result.order.resize(count);
        std::iota(result.order.begin(), result.order.end(), 0u);
        std::stable_sort(result.order.begin(), result.order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return codes[a] < codes[b]; });
        for (const std::uint32_t i : result.order) {
            codes_.push_back(codes[i]);
        }
        result.nodes.resize(2 * count);
        if (count > 0) {
            build(0, static_cast<std::uint32_t>(count - 1), 0, lbvh_end);
        }
    }

    SerialLbvh result;

private:
    /// Writes the subtree over first..last; returns its root's box. `inner` is the root's number if
    /// it is no leaf.
    BoxRecord build(std::uint32_t first, std::uint32_t last, std::uint32_t inner,
                    std::uint32_t escape) {
        BoxRecord box;
        std::uint32_t place;
        std::uint32_t child;
        if (first == last) {
            child = result.order[first];
            box = boxes_[child];
            place = 2 * first + 1;
        } else {
            std::uint32_t split = first;
            while (same_side(first, split + 1, last)) {
                ++split;
            }
            const std::uint32_t right = 2 * (split + 1) + (split + 1 == last ? 1 : 0);
            child = 2 * split + (split == first ? 1 : 0);
            box = box_union(build(first, split, split, right),
                            build(split + 1, last, split + 1, escape));
            place = 2 * inner;
        }
        result.nodes[place] = {box.low_x,  box.low_y,  box.low_z,  child,
                               box.high_x, box.high_y, box.high_z, escape};
        return box;
    }

    std::uint64_t key(std::uint32_t i) const { return std::uint64_t(codes_[i]) << 32 | i; }

    /// Whether leaf i is on the first leaf's side of the highest bit in which first and last
    /// differ.
    bool same_side(std::uint32_t first, std::uint32_t i, std::uint32_t last) const {
        const int bit = 63 - std::countl_zero(key(first) ^ key(last));
        return (key(i) >> bit) == (key(first) >> bit);
    }

    const std::vector<BoxRecord>& boxes_;
    std::vector<std::uint32_t> codes_;
};

inline SerialLbvh build_serially(const std::vector<BoxRecord>& boxes) {
    return SerialBuild(boxes).result;
}

} // namespace argand
