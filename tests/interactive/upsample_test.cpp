#include "interactive/upsample.hpp"

#include <gtest/gtest.h>

namespace argand {
namespace {

Image ramp(int width, int height) {
    Image image{.width = width, .height = height, .pixels = {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image.pixels.emplace_back((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                      (static_cast<float>(y) + 0.5f) / static_cast<float>(height),
                                      2);
        }
    }
    return image;
}

TEST(Upsampling, KeepsWhatIsLinear) {
    const Image large = upsampled(ramp(8, 5), 31, 17), expected = ramp(31, 17);
    ASSERT_EQ(large.pixels.size(), expected.pixels.size());
    for (int y = 2; y < 15; ++y) { // beyond the outermost middles it is constant
        for (int x = 2; x < 29; ++x) {
            const auto i = static_cast<std::size_t>(y * 31 + x);
            EXPECT_NEAR(large.pixels[i].x, expected.pixels[i].x, 1e-6f);
            EXPECT_NEAR(large.pixels[i].y, expected.pixels[i].y, 1e-6f);
            EXPECT_FLOAT_EQ(large.pixels[i].z, 2);
        }
    }
    EXPECT_EQ(large.pixels.front(), ramp(8, 5).pixels.front());
    EXPECT_EQ(large.pixels.back(), ramp(8, 5).pixels.back());
}

TEST(Upsampling, OfTheSameSizeChangesNothing) {
    EXPECT_EQ(upsampled(ramp(7, 3), 7, 3).pixels, ramp(7, 3).pixels);
}

TEST(Upsampling, OfOnePixelIsConstant) {
    for (const glm::vec3& pixel : upsampled(ramp(1, 1), 3, 2).pixels) {
        EXPECT_EQ(pixel, glm::vec3(0.5f, 0.5f, 2));
    }
}

} // namespace
} // namespace argand
