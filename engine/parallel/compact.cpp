#include "parallel/compact.hpp"

#include "device/primitives.hpp"
#include "kernels/compact_parts_serial.hpp"
#include "kernels/compact_parts_shared.hpp"
#include "kernels/compact_parts_subgroup.hpp"
#include "parallel/parts.hpp"

namespace argand {

void compact(Device& device, const Buffer& flags, const Buffer& values, const Buffer& out,
             const Buffer& counts, std::uint32_t count_index, const Count& count) {
    check_room("compacting", flags, count, sizeof(uint));
    check_room("compacting", values, count, sizeof(uint));
    if (Primitives* primitives = device.primitives()) {
        primitives->compact(flags, values, out, counts, count_index, count);
        return;
    }
    const Variant variant = variant_of(device.info());
    const PartsRecord parts = variant_parts(variant, count);
    const Buffer sums = device.scratch("compact: kept of parts", parts.parts * sizeof(uint));
    if (parts.parts > 1) {
        reduce_parts(device, flags, sums, 0, count, parts, reduce_op_count);
    }
    for_variant<kernels::compact_parts_serial, kernels::compact_parts_subgroup,
                kernels::compact_parts_shared>(
        variant, parts, [&]<class Kernel>(std::uint64_t threads) {
            dispatch(device,
                     Kernel{.flags = flags,
                            .values = values,
                            .counts = counts_or(count, flags),
                            .part_sums = sums,
                            .kept = out,
                            .totals = counts,
                            .params = {count_record(count), parts, count_index}},
                     threads);
        });
}

} // namespace argand
