#include "parallel/parts.hpp"

#include "base/error.hpp"
#include "kernels/reduce_parts.hpp"

#include <algorithm>

namespace argand {

namespace {

PartsRecord parts_of(std::uint64_t bound, std::uint64_t elements_a_part, std::uint64_t most,
                     std::uint32_t grain) {
    const std::uint64_t wanted = (bound + elements_a_part - 1) / elements_a_part;
    return {static_cast<uint>(std::clamp<std::uint64_t>(wanted, 1, most)), grain};
}

} // namespace

Variant variant_of(const DeviceInfo& info) {
    return info.lane_serial()        ? Variant::serial
           : info.features.subgroups ? Variant::subgroup
                                     : Variant::shared;
}

PartsRecord group_parts(const Count& count) { return parts_of(count.bound, 2048, 1024, 64); }

PartsRecord variant_parts(Variant variant, const Count& count) {
    if (variant != Variant::serial) {
        return group_parts(count);
    }
    // A second dispatch costs more than one lane needs for a few elements; beyond that, two groups
    // of eight lanes at least, for groups are dealt to cores.
    if (count.bound <= 4096) {
        return {1, 16};
    }
    PartsRecord parts = parts_of(count.bound, 8192, 512, 16);
    parts.parts = (parts.parts + 15) / 16 * 16;
    return parts;
}

CountRecord count_record(const Count& count) {
    return {static_cast<uint>(count.bound), count.index, count.on_device() ? 1u : 0u};
}

const Buffer& counts_or(const Count& count, const Buffer& bound_anyway) {
    return count.on_device() ? count.buffer : bound_anyway;
}

void reduce_parts(Device& device, const Buffer& in, const Buffer& results, uint first_out,
                  const Count& count, PartsRecord parts, uint op) {
    dispatch(device,
             kernels::reduce_parts{.in_elements = in,
                                   .counts = counts_or(count, in),
                                   .results = results,
                                   .params = {count_record(count), parts, op, first_out}},
             groups_of<kernels::reduce_parts>(parts.parts));
}

void check_room(const char* doing, const Buffer& buffer, const Count& count, std::uint64_t bytes) {
    if (buffer.size() / bytes < count.bound) {
        fail("{}: {} elements of {} bytes exceed the {} bytes of '{}'; please report this", doing,
             count.bound, bytes, buffer.size(), buffer.name());
    }
}

} // namespace argand
