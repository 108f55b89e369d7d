#include "frames.hpp"

#include "base/error.hpp"
#include "numbers.hpp"

#include <optional>
#include <string_view>

namespace argand {

namespace {

constexpr std::uint64_t most_frames = 10'000'000; // as the number of the last frame

/// Where a frame's number goes in a name.
struct NumberPlace {
    std::size_t begin = 0, length = 0;
    std::size_t digits = 0; ///< at least; the rest are zeros
};

/// The place at a percent sign, if there is one.
std::optional<NumberPlace> place_at(const std::string& pattern, std::size_t percent) {
    std::size_t at = percent + 1;
    std::size_t digits = 0;
    if (at < pattern.size() && pattern[at] == '0') {
        for (++at; at < pattern.size() && pattern[at] >= '0' && pattern[at] <= '9'; ++at) {
            digits = 10 * digits + static_cast<std::size_t>(pattern[at] - '0');
            if (digits > 20) {
                return std::nullopt;
            }
        }
    }
    if (at >= pattern.size() || pattern[at] != 'd') {
        return std::nullopt;
    }
    return NumberPlace{percent, at + 1 - percent, digits};
}

std::optional<NumberPlace> find_place(const std::string& pattern) {
    const std::size_t percent = pattern.find('%');
    if (percent == std::string::npos || pattern.find('%', percent + 1) != std::string::npos) {
        return std::nullopt;
    }
    return place_at(pattern, percent);
}

} // namespace

FrameRange parse_frame_range(const std::string& text) {
    const std::size_t colon = text.find(':');
    if (colon != std::string::npos) {
        const auto first = parse_number<std::uint64_t>(std::string_view(text).substr(0, colon)),
                   end = parse_number<std::uint64_t>(std::string_view(text).substr(colon + 1));
        if (first && end && *first < *end && *end <= most_frames) {
            return {*first, *end};
        }
    }
    throw UsageError(fmt::format("reading --frames '{}': write A:B for the frames from A up to B - "
                                 "1, such as 0:48, with A below B and B at most {}",
                                 text, most_frames));
}

Shutter parse_shutter(const std::string& text) {
    constexpr double most = 1e6; // frames before or after
    const std::size_t colon = text.find(':');
    if (colon != std::string::npos) {
        const auto open = parse_number<double>(std::string_view(text).substr(0, colon)),
                   close = parse_number<double>(std::string_view(text).substr(colon + 1));
        if (open && close && *open >= -most && *open < *close && *close <= most) {
            return {*open, *close};
        }
    }
    throw UsageError(fmt::format("reading --shutter '{}': write OPEN:CLOSE in shares of a frame, "
                                 "such as 0:0.5, with OPEN below CLOSE",
                                 text));
}

void check_frame_pattern(const std::string& pattern) {
    if (!find_place(pattern)) {
        throw UsageError(fmt::format("writing '{}': with --frames the name needs one place for the "
                                     "frame's number, such as frame_%04d.png",
                                     pattern));
    }
}

std::string frame_name(const std::string& pattern, std::uint64_t frame) {
    const NumberPlace place = find_place(pattern).value();
    return pattern.substr(0, place.begin) + fmt::format("{:0{}}", frame, place.digits) +
           pattern.substr(place.begin + place.length);
}

} // namespace argand
