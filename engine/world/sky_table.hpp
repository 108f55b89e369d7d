#pragma once

#include "scene/environment.hpp"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace argand {

/// What kernels read of a scene's environment: the words that shared/sky_record.h describes.
struct SkyTable {
    std::vector<std::uint32_t> words;
    int width = 0, height = 0;  ///< of the picture
    std::uint32_t halvings = 0; ///< of its sides, so that it fits
};

/// Words of a table with a picture of this size.
std::uint64_t words_of_sky(int width, int height);

/// The picture's sides are halved until the table has at most so many words. A share of the samples
/// goes to cells that are not black whatever their brightness, so that random numbers of 24 bits
/// reach all of them beside a sun that is a billion times as bright.
SkyTable make_sky_table(const Environment& environment, std::uint64_t most_words);

/// Two words with a texel; see sky_radiance().
glm::uvec2 packed_radiance(const glm::vec3& radiance);

/// Two numbers with which sample_sky() finds this unit direction of the world, within the sun by
/// its disc.
glm::dvec2 numbers_of_direction(const SkyTable& table, const glm::vec3& towards);

} // namespace argand
