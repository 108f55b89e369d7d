#include "parallel/reduce.hpp"

#include "device/primitives.hpp"
#include "kernels/reduce_box.hpp"
#include "parallel/parts.hpp"
#include "shared/geometry_records.h"

namespace argand {

namespace {

constexpr PartsRecord one_part{1, 16};

void reduce(Device& device, const Buffer& in, const Buffer& out, std::uint32_t out_index,
            const Count& count, uint op) {
    check_room("reducing", in, count, sizeof(uint));
    if (Primitives* primitives = device.primitives()) {
        primitives->reduce(in, out, out_index, count, op);
        return;
    }
    const PartsRecord parts = group_parts(count);
    if (parts.parts == 1) {
        reduce_parts(device, in, out, out_index, count, parts, op);
        return;
    }
    const Buffer results = device.scratch("reduce: parts", parts.parts * sizeof(uint));
    reduce_parts(device, in, results, 0, count, parts, op);
    reduce_parts(device, results, out, out_index, parts.parts, one_part, op);
}

void reduce_box_parts(Device& device, const Buffer& boxes, const Buffer& results, uint first_out,
                      const Count& count, PartsRecord parts) {
    dispatch(device,
             kernels::reduce_box{.corners = boxes,
                                 .counts = counts_or(count, boxes),
                                 .results = results,
                                 .params = {count_record(count), parts, first_out}},
             groups_of<kernels::reduce_box>(parts.parts));
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
    const PartsRecord parts = group_parts(count);
    if (parts.parts == 1) {
        reduce_box_parts(device, boxes, out, out_index, count, parts);
        return;
    }
    const Buffer results =
        device.scratch("reduce: boxes of parts", parts.parts * sizeof(BoxRecord));
    reduce_box_parts(device, boxes, results, 0, count, parts);
    reduce_box_parts(device, results, out, out_index, parts.parts, one_part);
}

} // namespace argand
