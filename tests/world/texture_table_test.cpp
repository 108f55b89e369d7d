#include "world/texture_table.hpp"

#include "device_fixture.hpp"
#include "shared/texture_record.h"

#include <bit>
#include <gtest/gtest.h>
#include <memory>
#include <utility>

namespace argand::testing {
namespace {

std::uint32_t texel(int red, int green, int blue, int alpha = 255) {
    return std::bit_cast<std::uint32_t>(glm::u8vec4(red, green, blue, alpha));
}

TEST(TextureTable, HalvesInLinearLight) {
    const TextureImage image{
        .width = 2, .height = 1, .texels = {texel(0, 0, 100), texel(255, 0, 200)}};
    const TextureImage half = halved(image, true);
    ASSERT_EQ(half.texels.size(), 1u);
    const auto color = std::bit_cast<glm::u8vec4>(half.texels[0]);
    EXPECT_EQ(color.r, 188); // half of the light in sRGB
    EXPECT_EQ(color.g, 0);
    EXPECT_EQ(std::bit_cast<glm::u8vec4>(halved(image, false).texels[0]).b, 150);
}

TEST(TextureTable, HalvesByWhatIsPresent) {
    const TextureImage image{.width = 3, // the last column is left out
                             .height = 2,
                             .texels = {texel(255, 0, 0, 0), texel(0, 90, 0, 255), texel(1, 1, 1),
                                        texel(255, 0, 0, 0), texel(0, 90, 0, 255), texel(1, 1, 1)}};
    const TextureImage half = halved(image, true);
    ASSERT_EQ(half.texels.size(), 1u);
    EXPECT_EQ(std::bit_cast<glm::u8vec4>(half.texels[0]), glm::u8vec4(0, 90, 0, 128));
}

TEST(TextureTable, HalvesTheLargestUntilAllFit) {
    Scene scene;
    const auto add = [&](std::uint32_t width, std::uint32_t height) {
        TextureImage image{.width = width, .height = height};
        image.texels.assign(std::size_t{width} * height, texel(10, 20, 30));
        scene.images.push_back(std::make_shared<const TextureImage>(std::move(image)));
    };
    add(16, 16);
    add(64, 48);
    add(1, 300);
    EXPECT_EQ(fitting_images(scene, 256 + 64 * 48 + 300).halvings, 0u);
    const FittingImages fitting = fitting_images(scene, 256 + 64 * 48 / 4 + 299);
    EXPECT_EQ(fitting.halvings, 2u);
    EXPECT_EQ(fitting.images[0]->width, 16u);
    EXPECT_EQ(fitting.images[1]->width, 16u);
    EXPECT_EQ(fitting.images[1]->height, 12u);
    EXPECT_EQ(fitting.images[2]->height, 300u);
    EXPECT_EQ(fitting.images[1]->texels, std::vector<std::uint32_t>(16 * 12, texel(10, 20, 30)));
    // An image has a texel at least.
    EXPECT_EQ(fitting_images(scene, 1).images[2]->texels.size(), 1u);
}

class TextureTableOnDevice : public DeviceTest {};

TEST_F(TextureTableOnDevice, LiesBehindTheCodesOfSrgb) {
    Scene scene;
    for (const std::uint32_t width : {3u, 2u}) {
        TextureImage image{.width = width, .height = 1};
        image.texels.assign(width, texel(int(width), 0, 0));
        scene.textures.push_back({.image = static_cast<std::uint32_t>(scene.images.size())});
        scene.images.push_back(std::make_shared<const TextureImage>(std::move(image)));
    }
    Device& device = open();
    const TextureTable table = make_texture_table(device, scene);
    const auto records = download<TextureRecord>(device, table.records, 2);
    EXPECT_EQ(records[1].first, srgb_codes + 3);
    const auto texels = download<std::uint32_t>(device, table.texels, srgb_codes + 5);
    EXPECT_EQ(texels[srgb_codes + 4], texel(2, 0, 0));
    EXPECT_EQ(std::bit_cast<float>(texels[0]), 0.0f);
    EXPECT_NEAR(std::bit_cast<float>(texels[188]), 0.5029, 1e-4); // IEC 61966-2-1
    EXPECT_EQ(std::bit_cast<float>(texels[255]), 1.0f);
}

} // namespace
} // namespace argand::testing
