#include "accel/lbvh.hpp"

#include "accel/fences.hpp"
#include "kernels/code_distances.hpp"
#include "kernels/lbvh_codes.hpp"
#include "kernels/lbvh_fit.hpp"
#include "parallel/parts.hpp"
#include "parallel/radix_sort.hpp"
#include "parallel/reduce.hpp"
#include "shared/geometry_records.h"

#include <algorithm>

namespace argand {

namespace {

constexpr std::uint32_t code_bits = 30;

/// What the tree is built over. It refers to the buffers.
struct Leaves {
    const Buffer& boxes;
    const Buffer& distances; ///< see code_distances()
    const Count& count;
    bool in_order; ///< the boxes are in the order of their codes
};

/// Writes the nodes of a tree with a known order, and what only trees for rays have.
void fit(Device& device, const Lbvh& bvh, const Leaves& leaves) {
    const auto& [boxes, distances, count, in_order] = leaves;
    const bool for_rays = static_cast<bool>(bvh.costs);
    const Buffer ends = device.scratch("lbvh: ends", std::max<std::uint64_t>(count.bound, 1) *
                                                         sizeof(std::uint32_t));
    device.fill(ends, lbvh_end);
    dispatch(device,
             kernels::lbvh_fit{.boxes = boxes,
                               .distances = distances,
                               .order = bvh.order,
                               .counts = counts_or(count, distances),
                               .ends = ends,
                               .nodes = bvh.nodes,
                               .costs = for_rays ? bvh.costs : ends,
                               .parents = for_rays ? bvh.parents : ends,
                               .params = {count_record(count)},
                               .constants = {.fences = needs_fences(device),
                                             .for_rays = for_rays,
                                             .in_order = in_order}},
             count);
}

} // namespace

Lbvh build_lbvh(Device& device, const Buffer& boxes, const Count& count, bool for_rays) {
    const std::uint64_t bound = std::max<std::uint64_t>(count.bound, 1);
    Lbvh bvh{.order = device.allocate("lbvh order", bound * sizeof(std::uint32_t)),
             .nodes = device.allocate("lbvh nodes", 2 * bound * sizeof(LbvhNode))};
    if (for_rays) {
        bvh.costs = device.allocate("lbvh costs", bound * sizeof(ForestCost));
        bvh.parents = device.allocate("lbvh parents", bound * sizeof(std::uint32_t));
    }
    if (count.bound == 0) {
        return bvh;
    }
    const Buffer bounds = device.scratch("lbvh: bounds", sizeof(BoxRecord));
    const Buffer codes = device.scratch("lbvh: codes", bound * sizeof(std::uint32_t));
    const AccelParams params{count_record(count)};
    const Buffer& counts = counts_or(count, bounds);

    reduce_box(device, boxes, bounds, 0, count);
    dispatch(device,
             kernels::lbvh_codes{.boxes = boxes,
                                 .bounds = bounds,
                                 .counts = counts,
                                 .codes = codes,
                                 .order = bvh.order,
                                 .params = params},
             count);
    radix_sort_pairs(device, codes, bvh.order, count, code_bits);
    const Buffer distances = code_distances(device, codes, count, false);
    fit(device, bvh, {boxes, distances, count, false});
    return bvh;
}

Buffer code_distances(Device& device, const Buffer& codes, const Count& count, bool codes64) {
    Buffer distances = device.scratch("code distances", std::max<std::uint64_t>(count.bound, 1) *
                                                            sizeof(std::uint32_t));
    dispatch(device,
             kernels::code_distances{.codes = codes,
                                     .counts = counts_or(count, codes),
                                     .distances = distances,
                                     .params = {count_record(count)},
                                     .constants = {.codes64 = codes64}},
             count);
    return distances;
}

Lbvh build_lbvh_in_order(Device& device, const Buffer& boxes, const Buffer& distances,
                         const Buffer& order, const Count& count) {
    const std::uint64_t bound = std::max<std::uint64_t>(count.bound, 1);
    Lbvh bvh{.order = order, .nodes = device.allocate("lbvh nodes", 2 * bound * sizeof(LbvhNode))};
    if (count.bound > 0) {
        fit(device, bvh, {boxes, distances, count, true});
    }
    return bvh;
}

} // namespace argand
