#include "base/error.hpp"
#include "device/raster.hpp"
#include "device_fixture.hpp"
#include "kernels/add_neighbour.hpp"
#include "kernels/draw_triangles.hpp"

#include <gmock/gmock.h>

namespace argand {
namespace {

using Words = std::vector<std::uint32_t>;
using ::testing::HasSubstr;

/// A triangle of this depth that covers all pixels.
std::vector<glm::vec4> everywhere(float depth) {
    return {{-1, -1, depth, 1}, {3, -1, depth, 1}, {-1, 3, depth, 1}};
}

/// The upper left half of the pixels, but for those on the diagonal.
std::vector<glm::vec4> half() { return {{-1, -1, 0.5f, 1}, {1, -1, 0.5f, 1}, {-1, 1, 0.5f, 1}}; }

class Rasterising : public DeviceTest {
protected:
    void SetUp() override {
        DeviceTest::SetUp();
        device_ = &open();
        if (!device_->raster()) {
            GTEST_SKIP() << device_->info().name << " has no rasteriser";
        }
    }

    struct Size {
        std::uint32_t width, height, layers;
    };

    Words drawn(const std::vector<glm::vec4>& corners, const Words& values, const Size& size,
                std::uint32_t step_of_layers = 0) {
        Device& device = *device_;
        const std::size_t count = std::size_t(size.width) * size.height * size.layers;
        const Buffer result = upload(device, "result", Words(count + 2, 7));
        draw(*device.raster(),
             kernels::draw_triangles{.corners = upload(device, "corners", corners),
                                     .values = upload(device, "values", values),
                                     .constants = {.step_of_layers = step_of_layers}},
             static_cast<std::uint32_t>(corners.size()),
             {.to = BufferView(result, 4, 4 * count),
              .width = size.width,
              .height = size.height,
              .layers = size.layers,
              .empty = {9}});
        Words words = download<std::uint32_t>(device, result, count + 2);
        EXPECT_EQ(words.front(), 7u);
        EXPECT_EQ(words.back(), 7u);
        return {words.begin() + 1, words.end() - 1};
    }

    Device* device_ = nullptr;
};

// Where it does not, the tests of drawing would skip themselves unnoticed.
TEST_F(DeviceTest, LavapipeDraws) {
    const DeviceInfo& info = open().info();
    if (info.name.find("llvmpipe") != std::string::npos) {
        EXPECT_TRUE(info.features.raster) << info.driver;
        EXPECT_NE(open().raster(), nullptr);
    }
}

TEST_F(Rasterising, CoversEachPixelOfEachLayer) {
    for (const Size& size : {Size{1, 1, 1}, Size{1, 1, 6}, Size{7, 5, 3}, Size{300, 200, 6}}) {
        SCOPED_TRACE(size.width);
        Words expected;
        for (std::uint32_t layer = 0; layer < size.layers; ++layer) {
            expected.insert(expected.end(), std::size_t(size.width) * size.height, 20 + 3 * layer);
        }
        EXPECT_EQ(drawn(everywhere(0.5f), {20}, size, 3), expected);
    }
}

TEST_F(Rasterising, WritesRowsFromTheTop) {
    const Words words = drawn(half(), {1}, {4, 4, 1});
    // The middles of the diagonal's pixels lie on the triangle's edge, which may or may not count.
    const std::uint32_t on_edge = words[3];
    EXPECT_EQ(words,
              (Words{1, 1, 1, on_edge, 1, 1, words[6], 9, 1, words[9], 9, 9, words[12], 9, 9, 9}));
}

TEST_F(Rasterising, WithoutTrianglesWritesEmptyValues) {
    EXPECT_EQ(drawn({}, {1}, {3, 2, 2}), Words(12, 9));
}

TEST_F(Rasterising, TheLargestDepthStaysAndOfEqualOnesTheFirst) {
    const auto both = [](float first, float second) {
        std::vector<glm::vec4> corners = everywhere(first);
        const std::vector<glm::vec4> more = everywhere(second);
        corners.insert(corners.end(), more.begin(), more.end());
        return corners;
    };
    EXPECT_EQ(drawn(both(0.25f, 0.5f), {1, 2}, {2, 2, 1}), Words(4, 2));
    EXPECT_EQ(drawn(both(0.5f, 0.25f), {1, 2}, {2, 2, 1}), Words(4, 1));
    EXPECT_EQ(drawn(both(0.5f, 0.5f), {1, 2}, {2, 2, 1}), Words(4, 1));
}

TEST_F(Rasterising, DropsWhatLiesBehindTheEyeOrBeforeTheNearestDepth) {
    EXPECT_EQ(drawn(everywhere(1.5f), {1}, {2, 2, 1}), Words(4, 9));
    std::vector<glm::vec4> behind = everywhere(0.5f);
    for (glm::vec4& corner : behind) {
        corner = -corner;
    }
    EXPECT_EQ(drawn(behind, {1}, {2, 2, 1}), Words(4, 9));
}

TEST_F(Rasterising, WaitsForKernelsAndKernelsForIt) {
    Device& device = *device_;
    constexpr std::uint32_t n = 64;
    const Buffer corners = upload(device, "corners", everywhere(0.5f));
    Buffer values = upload(device, "values", Words(n, 1));
    const Buffer drawn = upload(device, "drawn", Words(n, 0));
    Buffer sums = upload(device, "sums", Words(n, 0));
    for (int i = 0; i < 20; ++i) {
        draw(*device.raster(), kernels::draw_triangles{.corners = corners, .values = values}, 3,
             {.to = drawn, .width = 8, .height = 8});
        // Each pixel is added to its neighbour, which has the same value.
        dispatch(device, kernels::add_neighbour{.from_values = drawn, .to_values = sums}, n);
        std::swap(values, sums);
    }
    EXPECT_EQ(download<std::uint32_t>(device, drawn, n), Words(n, 1u << 19));
}

TEST_F(Rasterising, ImagesOfDifferentSizesAreInUseAtOnce) {
    Device& device = *device_;
    const Buffer corners = upload(device, "corners", everywhere(0.5f));
    const Buffer result = device.allocate("result", 4 * 8 * 8);
    Words sizes;
    for (std::uint32_t i = 1; i <= 8; ++i) {
        draw(*device.raster(),
             kernels::draw_triangles{.corners = corners,
                                     .values = upload(device, "values", Words{i})},
             3, {.to = BufferView(result, 4 * (i - 1) * 8, 4 * i), .width = i, .height = 1});
    }
    const Words words = download<std::uint32_t>(device, result, 64);
    for (std::uint32_t i = 1; i <= 8; ++i) {
        EXPECT_EQ(words[(i - 1) * 8], i);
        EXPECT_EQ(words[(i - 1) * 8 + i - 1], i);
    }
    EXPECT_GT(device.memory_by_name().at("raster image").current, 0u);
}

TEST_F(Rasterising, RefusesSizesThatTheDeviceCannotDraw) {
    device_ = &open_anew({"small", "", "image=16,layers=6"});
    EXPECT_EQ(drawn(everywhere(0.5f), {1}, {16, 16, 1}), Words(256, 1));
    for (const Size& size : {Size{17, 1, 1}, Size{1, 17, 1}, Size{0, 1, 1}, Size{1, 1, 7}}) {
        try {
            drawn(everywhere(0.5f), {1}, size);
            FAIL() << size.width << " x " << size.height << " in " << size.layers;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("'" + device_->info().name + "' draws 1 x 1 to"));
        }
    }
}

TEST_F(Rasterising, CanBeTurnedOff) {
    EXPECT_EQ(open_anew({"off", "raster", ""}).raster(), nullptr);
}

} // namespace
} // namespace argand
