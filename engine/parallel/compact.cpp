#include "parallel/compact.hpp"

#include "device/primitives.hpp"
#include "kernels/compact_parts_serial.hpp"
#include "kernels/compact_parts_shared.hpp"
#include "kernels/compact_parts_subgroup.hpp"
#include "parallel/parts.hpp"

namespace argand {

void compact(Device& device, const Buffer& flags, const Buffer& values, const Buffer& out,
             const WordAt& total, const Count& count) {
    check_room("compacting", flags, count, sizeof(uint));
    check_room("compacting", values, count, sizeof(uint));
    if (Primitives* primitives = device.primitives()) {
        primitives->compact(flags, values, out, total.buffer, total.index, count);
        return;
    }
    const Division division = divide(device, count);
    const Buffer sums =
        reduce_each_part(device, "compact: kept of parts", flags, division, reduce_op_count);
    for_variant<kernels::compact_parts_serial, kernels::compact_parts_subgroup,
                kernels::compact_parts_shared>(division, [&]<class Kernel>(std::uint64_t threads) {
        dispatch(device,
                 Kernel{.flags = flags,
                        .values = values,
                        .counts = counts_or(count, flags),
                        .part_sums = sums,
                        .kept = out,
                        .totals = total.buffer,
                        .params = {count_record(count), division.parts, total.index}},
                 threads);
    });
}

} // namespace argand
