#include "accel/lbvh.hpp"

#include "accel/stopgap.hpp"
#include "kernels/lbvh_codes.hpp"
#include "kernels/lbvh_fit.hpp"
#include "shared/geometry_records.h"

#include <algorithm>

namespace argand {

namespace {

constexpr std::uint32_t code_bits = 30;

/// See lbvh_fit.comp.
bool needs_fences(const Device& device) {
    return device.info().driver.find("llvmpipe") == std::string::npos;
}

template <class Kernel>
void dispatch_count(Device& device, const Kernel& kernel, const Count& count) {
    if (count.on_device()) {
        dispatch_indirect(device, kernel, count.buffer, count.index);
    } else {
        dispatch(device, kernel, count.bound);
    }
}

} // namespace

Lbvh build_lbvh(Device& device, const Buffer& boxes, const Count& count) {
    const std::uint64_t bound = std::max<std::uint64_t>(count.bound, 1);
    Lbvh bvh{.order = device.allocate("lbvh order", bound * sizeof(std::uint32_t)),
             .nodes = device.allocate("lbvh nodes", 2 * bound * sizeof(LbvhNode))};
    if (count.bound == 0) {
        return bvh;
    }
    const Buffer bounds = device.allocate("lbvh bounds", sizeof(BoxRecord));
    const Buffer codes = device.allocate("lbvh codes", bound * sizeof(std::uint32_t));
    const Buffer ends = device.allocate("lbvh ends", bound * sizeof(std::uint32_t));
    const AccelParams params{.count = static_cast<std::uint32_t>(count.bound),
                             .count_index = count.on_device() ? count.index : no_count_index};
    const Buffer& counts = count.on_device() ? count.buffer : bounds;

    stopgap::reduce_box(device, boxes, bounds, 0, count);
    dispatch_count(device,
                   kernels::lbvh_codes{.boxes = boxes,
                                       .bounds = bounds,
                                       .counts = counts,
                                       .codes = codes,
                                       .order = bvh.order,
                                       .params = params},
                   count);
    stopgap::radix_sort_pairs(device, codes, bvh.order, count, code_bits);
    device.fill(ends, lbvh_end);
    dispatch_count(device,
                   kernels::lbvh_fit{.boxes = boxes,
                                     .codes = codes,
                                     .order = bvh.order,
                                     .counts = counts,
                                     .ends = ends,
                                     .nodes = bvh.nodes,
                                     .params = params,
                                     .constants = {.fences = needs_fences(device)}},
                   count);
    return bvh;
}

} // namespace argand
