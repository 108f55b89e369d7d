#pragma once

#include "device/count.hpp"
#include "device/device.hpp"
#include "shared/parallel_records.h"

namespace argand {

/// Which invocations work on a part. Devices that run lanes one after another take a lane for each
/// part, others a work-group, whose lanes co-operate through subgroups or, where there are none,
/// through shared memory alone.
enum class Variant : std::uint8_t { serial, subgroup, shared };

Variant variant_of(const DeviceInfo& info);

/// How a primitive divides its elements. It refers to the count.
struct Division {
    const Count& count;
    Variant variant;
    PartsRecord parts;
};

/// Parts for kernels that work on a part with a group, whatever the variant.
Division divide_among_groups(const Device& device, const Count& count);
/// Parts for kernels that work on a part with a lane or a group, as the variant says.
Division divide(const Device& device, const Count& count);

CountRecord count_record(const Count& count);
/// The buffer to bind as `counts`: the count's own, or `bound_anyway` where the host knows the
/// count and kernels do not read it.
const Buffer& counts_or(const Count& count, const Buffer& bound_anyway);

/// Reduces each part of `in` to results[first_out + part], with a reduce_op of
/// shared/parallel_records.h.
void reduce_parts(Device& device, const Buffer& in, const Division& division, const Buffer& results,
                  uint first_out, uint op);

/// As reduce_parts, into scratch memory of this name. With a single part the result is undefined:
/// no later part needs it.
Buffer reduce_each_part(Device& device, const char* name, const Buffer& in,
                        const Division& division, uint op);

/// Invocations to dispatch so that each of `count` work-groups of a kernel runs.
template <class Kernel> std::uint64_t groups_of(std::uint64_t count) {
    return count * Kernel::info.local_size[0];
}

/// Calls record.operator()<Kernel>(threads) with the kernel of the variant and the invocations that
/// the parts take.
template <class Serial, class Subgroup, class Shared, class Record>
void for_variant(const Division& division, const Record& record) {
    const std::uint64_t parts = division.parts.parts;
    switch (division.variant) {
    case Variant::serial:
        record.template operator()<Serial>(parts);
        break;
    case Variant::subgroup:
        record.template operator()<Subgroup>(groups_of<Subgroup>(parts));
        break;
    case Variant::shared:
        record.template operator()<Shared>(groups_of<Shared>(parts));
        break;
    }
}

/// Throws Error unless the buffer has room for `count` elements of `bytes` bytes. doing: what the
/// message says, such as "sorting".
void check_room(const char* doing, const Buffer& buffer, const Count& count, std::uint64_t bytes);

} // namespace argand
