// Mip levels of images: their means, and lookups in them.
#include "world/mip_maps.hpp"

#include "methods/textured.hpp"
#include "shared/texture.h"

#include <gtest/gtest.h>
#include <random>

namespace argand::testing {
namespace {

/// The mean of a level's texels, in linear light.
glm::dvec4 mean_of_level(const std::vector<std::uint32_t>& words, std::size_t first,
                         std::size_t count) {
    glm::dvec4 sum(0);
    for (std::size_t i = 0; i < count; ++i) {
        sum += glm::dvec4(texel_of_mip(words[first + 2 * i], words[first + 2 * i + 1]));
    }
    return sum / double(count);
}

TEST(MipMaps, HaveTheMeanOfTheImageInEveryLevel) {
    std::mt19937 random(2);
    for (const auto& [width, height] :
         {std::pair{2u, 2u}, {1u, 4096u}, {5u, 3u}, {17u, 1u}, {64u, 64u}, {127u, 33u}}) {
        TextureImage image{.width = width, .height = height};
        glm::dvec4 mean(0);
        for (std::uint32_t i = 0; i < width * height; ++i) {
            // Half of the texels are black and half are white, but for a little noise.
            const int code = (i % width + i / width) % 2 == 0 ? 255 : int(random() % 3);
            image.texels.push_back(texel(code, code / 2, 200, code));
            mean += glm::dvec4(linear(code), linear(code / 2), linear(200), code / 255.0);
        }
        mean /= double(width * height);
        const std::vector<std::uint32_t> words = mip_words(image);
        EXPECT_EQ(words.size(), mip_word_count(image));
        const std::uint32_t last = last_mip(width, height);
        EXPECT_EQ(mip_size(width, last) * mip_size(height, last), 1u);
        for (std::uint32_t level = 1; level <= last; ++level) {
            const std::size_t count = mip_size(width, level) * mip_size(height, level);
            const std::size_t first = words_before_mip(width, height, level) - width * height;
            ASSERT_LE(first + 2 * count, words.size());
            const glm::dvec4 found = mean_of_level(words, first, count);
            for (int channel = 0; channel < 4; ++channel) {
                EXPECT_NEAR(found[channel], mean[channel], 1e-4 * mean[channel])
                    << width << " x " << height << ", level " << level << ", " << channel;
            }
        }
    }
}

TEST(MipMaps, OfOneTexelAreNone) {
    EXPECT_TRUE(mip_words({.width = 1, .height = 1, .texels = {7}}).empty());
}

TEST(MipMaps, LevelsRiseByOneWhereConesAreTwiceAsWide) {
    TextureRecord t{};
    t.width = 256;
    t.height = 64;
    // A square of 2 × 2 shows the whole image once: 128 × 32 texels per unit.
    const auto level = [&](real width, real cosine) {
        return mip_level(t, 0.5f, 2, width, cosine);
    };
    const real texel = std::sqrt(2 / (0.5f * 256 * 64));
    EXPECT_EQ(level(0, 1), 0);
    EXPECT_EQ(level(texel, 1), 0);
    real before = 0;
    for (real width = texel; width < 1000; width *= 1.05f) {
        EXPECT_GE(level(width, 1), before);
        EXPECT_NEAR(level(width, 1), std::min(std::log2(width / texel), real(8)), 0.06f);
        before = level(width, 1);
    }
    EXPECT_NEAR(level(4 * texel, 0.25f), 3, 1e-3f);
    EXPECT_EQ(level(std::numeric_limits<real>::max(), 1), 8);
    EXPECT_EQ(mip_level(t, 0, 0, 1, 1), 0);
    EXPECT_EQ(mip_level(t, 0.5f, 0, 1, 1), 8);
}

} // namespace
} // namespace argand::testing
