#pragma once

#include "session/shutter.hpp"

#include <cstdint>
#include <string>

namespace argand {

/// Frames [first, end) of an animation.
struct FrameRange {
    std::uint64_t first = 0, end = 0;
};

/// Reads "A:B". Throws UsageError unless 0 <= A < B.
FrameRange parse_frame_range(const std::string& text);

/// Reads "OPEN:CLOSE", shares of a frame's time counted from the frame's moment. Throws UsageError
/// unless OPEN < CLOSE.
Shutter parse_shutter(const std::string& text);

/// Throws UsageError unless the name has one place for a frame's number: %d, or %04d and the like.
void check_frame_pattern(const std::string& pattern);

/// The pattern with the number in its place.
std::string frame_name(const std::string& pattern, std::uint64_t frame);

} // namespace argand
