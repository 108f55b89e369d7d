// Differentials and footprints on the device under test, compared with the host.
#include "device_fixture.hpp"
#include "footprint_case.h"
#include "kernels/test_footprint.hpp"
#include "lights.hpp"

#include <array>
#include <cstring>

namespace argand {
namespace {

class FootprintOnDevice : public DeviceTest {};

TEST_F(FootprintOnDevice, AgreesWithTheHost) {
    Device& device = open();
    std::mt19937 bits(2);
    const std::size_t count = 20'000;
    std::vector<LightRecord> lights;
    std::normal_distribution<float> normal;
    const auto any_point = [&] { return glm::vec3(normal(bits), normal(bits), normal(bits)); };
    for (std::size_t i = 0; i < count; ++i) {
        LightRecord l = testing::triangle_light(any_point(), glm::normalize(any_point()),
                                                any_point(), glm::vec3(2), i % 2);
        l.kind = static_cast<std::uint32_t>(i / 6 % 5);
        l.cos_inner = 0.9f;
        l.cos_outer = 0.5f;
        lights.push_back(l);
    }
    const Buffer results = device.allocate("results", count * sizeof(FootprintResult));
    dispatch(
        device,
        kernels::test_footprint{.lights = upload(device, "lights", lights), .results = results},
        count);
    const auto on_device = download<FootprintResult>(device, results, count);
    std::size_t unlike = 0;
    std::size_t differing = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const FootprintResult host = footprint_case(lights[i], i);
        const FootprintResult& other = on_device[i];
        const std::array pairs = {
            std::pair(host.extent_x, other.extent_x), std::pair(host.extent_y, other.extent_y),
            std::pair(host.extent_z, other.extent_z), std::pair(host.area, other.area),
            std::pair(host.weight, other.weight),     std::pair(host.spread_u, other.spread_u),
            std::pair(host.spread_v, other.spread_v), std::pair(host.scale, other.scale)};
        bool like = true;
        for (const auto& [a, b] : pairs) {
            ASSERT_GE(a, 0.0f);
            like = like && std::abs(a - b) <= 1e-3f * std::abs(a);
        }
        unlike += !like;
        differing += std::memcmp(&host, &other, sizeof(FootprintResult)) != 0;
    }
    // Grazing ones, whose footprints are equally uncertain on the host.
    EXPECT_LE(unlike, count / 1000);
    if (device.info().driver.find("llvmpipe") != std::string::npos) {
        EXPECT_EQ(differing, 0u);
    }
}

} // namespace
} // namespace argand
