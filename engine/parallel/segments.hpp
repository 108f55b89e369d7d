#pragma once

#include "device/device.hpp"
#include "shared/segments.h"

namespace argand {

/// Elements in segments that lie side by side.
struct Segments {
    Buffer of_elements;               ///< uint per element: its segment, or no_segment
    Buffer ranges;                    ///< SegmentRange per segment, none of them empty
    std::uint32_t first = 0, end = 0; ///< the elements to process
};

/// Lanes of 16 bytes in an element of which a box is found.
enum class Lanes : std::uint8_t {
    point = 1, ///< three floats and any word
    box = 2,   ///< BoxRecord
};

/// Writes the bounding boxes (BoxRecord) of `count` segments; low > high for one without elements.
/// `segments.ranges` is not used. The result does not depend on scheduling. Records only.
void segment_boxes(Device& device, const Buffer& elements, Lanes lanes, const Segments& segments,
                   std::uint32_t count, const Buffer& boxes);

/// Finds the stable partition of each segment into the elements whose flags[i] is 1, which come
/// first, and those whose flag is 0. Writes each element's place to places[i], and the number of
/// flagged elements of a segment to lefts[segment]. Elements of no segment keep their places.
/// `sums` is memory for a uint per element, and afterwards has the exclusive sums of all flags.
/// Records only.
void partition_segments(Device& device, const Buffer& flags, const Segments& segments,
                        const Buffer& sums, const Buffer& places, const Buffer& lefts);

/// Makes counts[i] copies of each of `elements` elements: sources[j] is the element of which copy j
/// is, in the order of the elements. copies: the sum of the counts. sums[i]: the first copy of
/// element i. Records only.
void expand(Device& device, const Buffer& counts, std::uint32_t elements, std::uint32_t copies,
            const Buffer& sums, const Buffer& sources);

} // namespace argand
