#include "parallel/parts.hpp"

#include "base/error.hpp"
#include "kernels/reduce_parts.hpp"

#include <algorithm>

namespace argand {

namespace {

/// Parts of about `elements_a_part` elements, each a multiple of `grain`.
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

Division divide_among_groups(const Device& device, const Count& count) {
    return {count, variant_of(device.info()), parts_of(count.bound, 2048, 1024, 64)};
}

Division divide(const Device& device, const Count& count) {
    Division division = divide_among_groups(device, count);
    if (division.variant == Variant::serial) {
        // One lane handles a few elements in less time than a second dispatch takes. More elements
        // go to two groups of eight lanes at least, for devices deal groups to cores.
        PartsRecord parts = parts_of(count.bound, 8192, 512, 16);
        parts.parts = (parts.parts + 15) / 16 * 16;
        division.parts = count.bound <= 4096 ? PartsRecord{1, 16} : parts;
    }
    return division;
}

CountRecord count_record(const Count& count) {
    return {static_cast<uint>(count.bound), count.index, count.on_device() ? 1u : 0u};
}

const Buffer& counts_or(const Count& count, const Buffer& bound_anyway) {
    return count.on_device() ? count.buffer : bound_anyway;
}

void reduce_parts(Device& device, const Buffer& in, const Division& division, const Buffer& results,
                  uint first_out, uint op) {
    const PartsRecord parts = division.parts;
    dispatch(device,
             kernels::reduce_parts{.in_elements = in,
                                   .counts = counts_or(division.count, in),
                                   .results = results,
                                   .params = {count_record(division.count), parts, op, first_out}},
             groups_of<kernels::reduce_parts>(parts.parts));
}

Buffer reduce_each_part(Device& device, const char* name, const Buffer& in,
                        const Division& division, uint op) {
    Buffer results = device.scratch(name, division.parts.parts * sizeof(uint));
    if (division.parts.parts > 1) {
        reduce_parts(device, in, division, results, 0, op);
    }
    return results;
}

void check_room(const char* doing, const Buffer& buffer, const Count& count, std::uint64_t bytes) {
    if (buffer.size() / bytes < count.bound) {
        fail("{}: {} elements of {} bytes exceed the {} bytes of '{}'; please report this", doing,
             count.bound, bytes, buffer.size(), buffer.name());
    }
}

} // namespace argand
