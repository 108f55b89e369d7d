#pragma once

#include "device/count.hpp"
#include "device/device.hpp"
#include "shared/parallel_records.h"

namespace argand {

/// How a primitive's kernels come: one lane per part for devices that run lanes serially, else one
/// work-group per part, whose lanes co-operate through subgroups or, where there are none, through
/// shared memory alone.
enum class Variant : std::uint8_t { serial, subgroup, shared };

Variant variant_of(const DeviceInfo& info);

/// Parts for kernels that work on a part with a group (of the variants, all but `serial`).
PartsRecord group_parts(const Count& count);
/// Parts for kernels that work on a part with what the variant says.
PartsRecord variant_parts(Variant variant, const Count& count);

CountRecord count_record(const Count& count);
/// The buffer to bind as counts: the count's own, or where the host knows the count one that is
/// bound anyway.
const Buffer& counts_or(const Count& count, const Buffer& bound_anyway);

/// Reduces each part to results[first_out + part], by one of the reduce_op's of
/// shared/parallel_records.h.
void reduce_parts(Device& device, const Buffer& in, const Buffer& results, uint first_out,
                  const Count& count, PartsRecord parts, uint op);

/// Invocations to dispatch so that each of `count` work-groups of a kernel runs.
template <class Kernel> std::uint64_t groups_of(std::uint64_t count) {
    return count * Kernel::info.local_size[0];
}

/// Calls record.operator()<Kernel>(threads) with the variant's kernel and the invocations that the
/// parts take.
template <class Serial, class Subgroup, class Shared, class Record>
void for_variant(Variant variant, PartsRecord parts, const Record& record) {
    switch (variant) {
    case Variant::serial:
        record.template operator()<Serial>(parts.parts);
        break;
    case Variant::subgroup:
        record.template operator()<Subgroup>(groups_of<Subgroup>(parts.parts));
        break;
    case Variant::shared:
        record.template operator()<Shared>(groups_of<Shared>(parts.parts));
        break;
    }
}

/// Throws Error unless the buffer has room for `count` elements of `bytes` bytes.
void check_room(const char* doing, const Buffer& buffer, const Count& count, std::uint64_t bytes);

} // namespace argand
