#include "parallel/reduce.hpp"

#include "device/primitives.hpp"
#include "kernels/reduce_box.hpp"
#include "parallel/parts.hpp"
#include "shared/geometry_records.h"

namespace argand {

namespace {

/// All of the elements as one part.
Division one_part(const Count& count) { return {count, Variant::shared, {1, 16}}; }

void reduce(Device& device, const Buffer& in, const Buffer& out, std::uint32_t out_index,
            const Count& count, uint op) {
    check_room("reducing", in, count, sizeof(uint));
    if (Primitives* primitives = device.primitives()) {
        primitives->reduce(in, out, out_index, count, op);
        return;
    }
    const Division division = divide_among_groups(device, count);
    if (division.parts.parts == 1) {
        reduce_parts(device, in, division, out, out_index, op);
        return;
    }
    const Buffer results = reduce_each_part(device, "reduce: parts", in, division, op);
    const Count parts = division.parts.parts;
    reduce_parts(device, results, one_part(parts), out, out_index, op);
}

void reduce_box_parts(Device& device, const Buffer& boxes, const Division& division,
                      const Buffer& results, uint first_out) {
    dispatch(
        device,
        kernels::reduce_box{.corners = boxes,
                            .counts = counts_or(division.count, boxes),
                            .results = results,
                            .params = {count_record(division.count), division.parts, first_out}},
        groups_of<kernels::reduce_box>(division.parts.parts));
}

} // namespace

void reduce_sum(Device& device, const Buffer& in, const Buffer& out, std::uint32_t out_index,
                const Count& count) {
    reduce(device, in, out, out_index, count, reduce_op_sum);
}

void reduce_min(Device& device, const Buffer& in, const Buffer& out, std::uint32_t out_index,
                const Count& count) {
    reduce(device, in, out, out_index, count, reduce_op_min);
}

void reduce_max(Device& device, const Buffer& in, const Buffer& out, std::uint32_t out_index,
                const Count& count) {
    reduce(device, in, out, out_index, count, reduce_op_max);
}

void reduce_box(Device& device, const Buffer& boxes, const Buffer& out, std::uint32_t out_index,
                const Count& count) {
    check_room("reducing boxes", boxes, count, sizeof(BoxRecord));
    if (Primitives* primitives = device.primitives()) {
        primitives->reduce_box(boxes, out, out_index, count);
        return;
    }
    const Division division = divide_among_groups(device, count);
    const Count parts = division.parts.parts;
    if (parts.bound == 1) {
        reduce_box_parts(device, boxes, division, out, out_index);
        return;
    }
    const Buffer results =
        device.scratch("reduce: boxes of parts", parts.bound * sizeof(BoxRecord));
    reduce_box_parts(device, boxes, division, results, 0);
    reduce_box_parts(device, results, one_part(parts), out, out_index);
}

} // namespace argand
