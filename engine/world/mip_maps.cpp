#include "world/mip_maps.hpp"

#include "image/srgb.hpp"
#include "shared/texture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace argand {

namespace {

struct Level {
    std::uint32_t width = 0, height = 0;
    std::vector<glm::vec4> texels; ///< linear
};

/// The part of a row or column that a texel of the next level covers: it begins and ends within
/// texels.
struct Cover {
    std::uint32_t first = 0, last = 0;
    double begin = 0, end = 0;

    Cover(std::uint32_t i, std::uint32_t fine, std::uint32_t coarse)
        : begin(double(i) * fine / coarse), end(double(i + 1) * fine / coarse) {
        first = static_cast<std::uint32_t>(begin);
        last = std::min(static_cast<std::uint32_t>(std::ceil(end)), fine) - 1;
    }
    double share_of(std::uint32_t texel) const {
        return (std::min(end, texel + 1.0) - std::max(begin, double(texel))) / (end - begin);
    }
};

/// texel_at: of the level below, by column and row.
template <class At>
Level level_above(std::uint32_t width, std::uint32_t height, const At& texel_at) {
    Level level{std::max(width / 2, 1u), std::max(height / 2, 1u), {}};
    level.texels.reserve(std::size_t{level.width} * level.height);
    for (std::uint32_t y = 0; y < level.height; ++y) {
        const Cover rows(y, height, level.height);
        for (std::uint32_t x = 0; x < level.width; ++x) {
            const Cover columns(x, width, level.width);
            glm::dvec4 sum(0);
            for (std::uint32_t row = rows.first; row <= rows.last; ++row) {
                for (std::uint32_t column = columns.first; column <= columns.last; ++column) {
                    sum += glm::dvec4(texel_at(column, row)) *
                           (rows.share_of(row) * columns.share_of(column));
                }
            }
            level.texels.emplace_back(sum);
        }
    }
    return level;
}

std::uint32_t code_of(double unit) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(unit, 0.0, 1.0) * 65535));
}

void add_words(const Level& level, std::vector<std::uint32_t>& words) {
    for (const glm::vec4& texel : level.texels) {
        const std::uint32_t red = code_of(std::sqrt(double(texel.r)));
        const std::uint32_t green = code_of(std::sqrt(double(texel.g)));
        const std::uint32_t blue = code_of(std::sqrt(double(texel.b)));
        words.push_back(red | green << 16);
        words.push_back(blue | code_of(texel.a) << 16);
    }
}

} // namespace

std::uint64_t mip_word_count(const TextureImage& image) {
    const std::uint32_t beyond = last_mip(image.width, image.height) + 1;
    return words_before_mip(image.width, image.height, beyond) -
           std::uint64_t{image.width} * image.height;
}

std::vector<std::uint32_t> mip_words(const TextureImage& image) {
    std::array<float, srgb_codes> linear{};
    for (std::size_t code = 0; code < linear.size(); ++code) {
        linear[code] = static_cast<float>(srgb_decode(static_cast<double>(code) / 255));
    }
    std::vector<std::uint32_t> words;
    words.reserve(mip_word_count(image));
    if (image.width <= 1 && image.height <= 1) {
        return words;
    }
    Level level =
        level_above(image.width, image.height, [&](std::uint32_t column, std::uint32_t row) {
            const auto texel =
                std::bit_cast<glm::u8vec4>(image.texels[std::size_t{row} * image.width + column]);
            return glm::vec4(linear[texel.r], linear[texel.g], linear[texel.b],
                             float(texel.a) / 255);
        });
    add_words(level, words);
    while (level.width > 1 || level.height > 1) {
        level =
            level_above(level.width, level.height, [&](std::uint32_t column, std::uint32_t row) {
                return level.texels[std::size_t{row} * level.width + column];
            });
        add_words(level, words);
    }
    return words;
}

} // namespace argand
