#include "autotune/autotune.hpp"
#include "device_fixture.hpp"
#include "image/files.hpp"
#include "image/metrics.hpp"
#include "scene/gltf.hpp"

#include <cstdint>
#include <gtest/gtest.h>

namespace argand {
namespace {

class SmallCaustic : public DeviceTest {};

/// The blur of the marble's caustic is nearly all of the error, in a few pixels, and ten times what
/// is usual. Paths find the caustic too rarely to see it.
TEST_F(SmallCaustic, SlowErrorIsToldAsItIs) {
    constexpr double target = 0.005;
    const Scene scene = load_gltf(ARGAND_SOURCE_DIR "/assets/glass_marble.glb");
    Device& device = open();
    const RenderPasses passes = [&](const RenderSettings& settings, const OnPass& on_pass) {
        return render(
            device, scene, settings, [](double) { return true; }, on_pass);
    };
    RenderSettings settings;
    settings.width = settings.height = 48;
    const auto reference = [&](std::uint32_t seed) {
        RenderSettings exact = settings;
        exact.method = "bidirectional"; // paths hardly find the caustic
        exact.samples = 256;
        exact.seed = seed;
        return render(device, scene, exact, [](double) { return true; }).layers[0].image;
    };
    const Image first = reference(101), second = reference(202);
    int reached = 0;
    for (const std::uint32_t seed : {3u, 6u}) {
        settings.seed = seed;
        const AutotunedRender tuned =
            autotune(passes, scene, settings, {}, {.error = target, .seconds = {}},
                     [](const AutotunedRender&) {});
        const double error = rel_mse(tuned.result.layers[0].image, first, second);
        ASSERT_TRUE(tuned.measured);
        EXPECT_LT(error, 2 * tuned.measured->error()) << seed;
        if (tuned.reached()) {
            ++reached;
            EXPECT_LT(error, 1.5 * target) << seed;
        }
    }
    EXPECT_GT(reached, 0);
}

} // namespace
} // namespace argand
