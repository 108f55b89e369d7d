#include "parallel/scan.hpp"

#include "device/primitives.hpp"
#include "kernels/scan_parts_serial.hpp"
#include "kernels/scan_parts_shared.hpp"
#include "kernels/scan_parts_subgroup.hpp"
#include "kernels/segment_totals.hpp"
#include "kernels/segmented_scan_group.hpp"
#include "kernels/segmented_scan_serial.hpp"
#include "parallel/parts.hpp"

namespace argand {

namespace {

/// Sums up each part, then scans the parts, each from the sum of those before it. That takes two
/// dispatches, whatever the count, and no group waits for another.
void scan(Device& device, const Buffer& in, const Buffer& out, const Count& count, bool inclusive) {
    check_room("scanning", in, count, sizeof(uint));
    check_room("scanning", out, count, sizeof(uint));
    if (count.bound == 0) {
        return;
    }
    if (Primitives* primitives = device.primitives()) {
        primitives->scan(in, out, count, inclusive);
        return;
    }
    const Division division = divide(device, count);
    const Buffer sums =
        reduce_each_part(device, "scan: sums of parts", in, division, reduce_op_sum);
    for_variant<kernels::scan_parts_serial, kernels::scan_parts_subgroup,
                kernels::scan_parts_shared>(division, [&]<class Kernel>(std::uint64_t threads) {
        dispatch(device,
                 Kernel{.in_elements = in,
                        .counts = counts_or(count, in),
                        .part_sums = sums,
                        .out_fours = out,
                        .out_elements = out,
                        .params = {count_record(count), division.parts, inclusive ? 1u : 0u}},
                 threads);
    });
}

} // namespace

void exclusive_scan(Device& device, const Buffer& in, const Buffer& out, const Count& count) {
    scan(device, in, out, count, false);
}

void inclusive_scan(Device& device, const Buffer& in, const Buffer& out, const Count& count) {
    scan(device, in, out, count, true);
}

void segmented_scan(Device& device, const Buffer& in, const Buffer& heads, const Buffer& out,
                    const Count& count) {
    check_room("scanning segments", in, count, sizeof(uint));
    check_room("scanning segments", heads, count, sizeof(uint));
    check_room("scanning segments", out, count, sizeof(uint));
    if (count.bound == 0) {
        return;
    }
    if (Primitives* primitives = device.primitives()) {
        primitives->segmented_scan(in, heads, out, count);
        return;
    }
    const Division division = divide(device, count);
    const PartsRecord parts = division.parts;
    const Buffer totals = device.scratch("scan: totals of parts", parts.parts * 2 * sizeof(uint));
    if (parts.parts > 1) {
        dispatch(device,
                 kernels::segment_totals{.in_elements = in,
                                         .heads = heads,
                                         .counts = counts_or(count, in),
                                         .part_totals = totals,
                                         .params = {count_record(count), parts}},
                 groups_of<kernels::segment_totals>(parts.parts));
    }
    for_variant<kernels::segmented_scan_serial, kernels::segmented_scan_group,
                kernels::segmented_scan_group>(division, [&]<class Kernel>(std::uint64_t threads) {
        dispatch(device,
                 Kernel{.in_elements = in,
                        .heads = heads,
                        .counts = counts_or(count, in),
                        .part_totals = totals,
                        .out_elements = out,
                        .params = {count_record(count), parts}},
                 threads);
    });
}

} // namespace argand
