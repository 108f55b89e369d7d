#include "parallel/segments.hpp"

#include "kernels/expand_sources.hpp"
#include "kernels/partition_places.hpp"
#include "kernels/segment_boxes.hpp"
#include "kernels/segment_boxes_end.hpp"
#include "parallel/parts.hpp"
#include "parallel/scan.hpp"
#include "shared/geometry_records.h"

namespace argand {

void segment_boxes(Device& device, const Buffer& elements, Lanes lanes, const Segments& segments,
                   std::uint32_t count, const Buffer& boxes) {
    const auto stride = static_cast<std::uint32_t>(lanes);
    check_room("finding boxes of segments", elements, segments.end, 16ull * stride);
    check_room("finding boxes of segments", segments.of_elements, segments.end, sizeof(uint));
    check_room("finding boxes of segments", boxes, count, sizeof(BoxRecord));
    if (count == 0) {
        return;
    }
    device.fill(BufferView(boxes, 0, count * sizeof(BoxRecord)), no_segment);
    dispatch(device,
             kernels::segment_boxes{.elements = elements,
                                    .segments = segments.of_elements,
                                    .box_words = boxes,
                                    .params = {.first = segments.first, .end = segments.end},
                                    .constants = {.lanes = stride}},
             (segments.end - segments.first + segment_run - 1) / segment_run);
    dispatch(device, kernels::segment_boxes_end{.box_words = boxes, .params = {.end = count}},
             count);
}

void partition_segments(Device& device, const Buffer& flags, const Segments& segments,
                        const Buffer& sums, const Buffer& places, const Buffer& lefts) {
    check_room("partitioning segments", flags, segments.end, sizeof(uint));
    check_room("partitioning segments", places, segments.end, sizeof(uint));
    if (segments.end == segments.first) {
        return;
    }
    exclusive_scan(device, flags, sums, segments.end);
    dispatch(device,
             kernels::partition_places{.flags = flags,
                                       .sums = sums,
                                       .segments = segments.of_elements,
                                       .ranges = segments.ranges,
                                       .places = places,
                                       .lefts = lefts,
                                       .params = {.first = segments.first, .end = segments.end}},
             segments.end - segments.first);
}

void expand(Device& device, const Buffer& counts, std::uint32_t elements, std::uint32_t copies,
            const Buffer& sums, const Buffer& sources) {
    check_room("expanding", sources, copies, sizeof(uint));
    exclusive_scan(device, counts, sums, elements);
    if (copies == 0) {
        return;
    }
    dispatch(device,
             kernels::expand_sources{.sums = sums,
                                     .sources = sources,
                                     .params = {.elements = elements, .copies = copies}},
             copies);
}

} // namespace argand
