#include "world/texel_range.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace argand {

namespace {

struct Span {
    std::uint32_t first = 0, last = 0;
};

/// The columns or rows of an image that an interval of places shows, as up to two spans.
struct Spans {
    std::array<Span, 2> spans;
    std::size_t count = 0;
};

Spans spans_of(double from, double to, std::uint32_t size, Wrap wrap, bool nearest) {
    const Spans all{{Span{0, size - 1}, Span{}}, 1};
    constexpr double far = 1e9;    // beyond which places are not exact
    constexpr double slack = 0.01; // texels, for rounding
    // Interpolation reads the texels whose middles are on either side.
    const double shift = nearest ? 0 : 0.5;
    from = std::floor(from - slack - shift);
    to = std::floor(to + slack + shift);
    if (!(from > -far && to < far)) {
        return all;
    }
    const auto clamped = [&](double x) {
        return static_cast<std::uint32_t>(std::clamp(x, 0.0, double(size) - 1));
    };
    if (wrap == Wrap::clamp_to_edge) {
        return {{Span{clamped(from), clamped(to)}, Span{}}, 1};
    }
    if (to - from + 1 >= size) {
        return all;
    }
    const double period = wrap == Wrap::repeat ? size : 2.0 * size;
    const double begin = from - period * std::floor(from / period);
    const double end = begin + (to - from);
    if (wrap == Wrap::repeat) {
        if (end < size) {
            return {{Span{clamped(begin), clamped(end)}, Span{}}, 1};
        }
        return {{Span{clamped(begin), size - 1}, Span{0, clamped(end - size)}}, 2};
    }
    const auto mirrored = [&](double x) {
        const double in_period = x - period * std::floor(x / period);
        return clamped(in_period < size ? in_period : period - 1 - in_period);
    };
    Span span{std::min(mirrored(begin), mirrored(end)), std::max(mirrored(begin), mirrored(end))};
    if (begin < size && end >= size) {
        span.last = size - 1;
    }
    if (end >= period) {
        span.first = 0;
    }
    return {{span, Span{}}, 1};
}

void add(TexelRange::Range& sum, const TexelRange::Range& other) {
    sum.low = glm::min(sum.low, other.low);
    sum.high = glm::max(sum.high, other.high);
}

} // namespace

TexelRange::TexelRange(const TextureImage& image) : image_(image) {
    std::uint32_t width = image.width;
    std::uint32_t height = image.height;
    while (width > 1 || height > 1) {
        const auto below = static_cast<std::uint32_t>(levels_.size());
        Level level{(width + 1) / 2, (height + 1) / 2, {}};
        level.texels.reserve(std::size_t{level.width} * level.height);
        for (std::uint32_t y = 0; y < level.height; ++y) {
            for (std::uint32_t x = 0; x < level.width; ++x) {
                Range range;
                for (std::uint32_t corner = 0; corner < 4; ++corner) {
                    add(range, at(below, std::min(2 * x + corner % 2, width - 1),
                                  std::min(2 * y + corner / 2, height - 1)));
                }
                level.texels.push_back(range);
            }
        }
        width = level.width;
        height = level.height;
        levels_.push_back(std::move(level));
    }
}

TexelRange::Range TexelRange::at(std::uint32_t level, std::uint32_t x, std::uint32_t y) const {
    if (level == 0) {
        const auto texel =
            std::bit_cast<glm::u8vec4>(image_.texels[std::size_t{y} * image_.width + x]);
        return {texel, texel};
    }
    const Level& of = levels_[level - 1];
    return of.texels[std::size_t{y} * of.width + x];
}

TexelRange::Range TexelRange::within(const glm::dvec2& from, const glm::dvec2& to,
                                     const Texture& texture) const {
    constexpr std::uint32_t most = 4; // texels in a row or column of a level
    const Spans columns = spans_of(from.x, to.x, image_.width, texture.wrap_u, texture.nearest);
    const Spans rows = spans_of(from.y, to.y, image_.height, texture.wrap_v, texture.nearest);
    Range range;
    for (std::size_t i = 0; i < columns.count * rows.count; ++i) {
        const Span& column = columns.spans[i % columns.count];
        const Span& row = rows.spans[i / columns.count];
        std::uint32_t level = 0;
        while ((column.last >> level) - (column.first >> level) >= most ||
               (row.last >> level) - (row.first >> level) >= most) {
            ++level;
        }
        for (std::uint32_t y = row.first >> level; y <= row.last >> level; ++y) {
            for (std::uint32_t x = column.first >> level; x <= column.last >> level; ++x) {
                add(range, at(level, x, y));
            }
        }
    }
    return range;
}

} // namespace argand
