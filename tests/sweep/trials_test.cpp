#include "device_fixture.hpp"
#include "image/metrics.hpp"
#include "scene/gltf.hpp"
#include "session/render.hpp"
#include "sweep/trials.hpp"

#include <array>

namespace argand {
namespace {

RenderSettings small(const std::string& method, std::uint64_t photons) {
    RenderSettings settings;
    settings.method = method;
    settings.width = settings.height = 24;
    settings.samples = 2;
    settings.photons = photons;
    return settings;
}

class TrialsTest : public ::testing::Test {
protected:
    std::optional<Trials> render(
        const RenderSettings& settings,
        const std::function<bool()>& keep_going = [] { return true; }) {
        constexpr std::array<std::uint32_t, 2> seeds{3, 4};
        return trials_on_device([] { return open_device(); }, scene_, keep_going)(settings, seeds);
    }

    Scene scene_ = load_gltf(ARGAND_SOURCE_DIR "/assets/cornell_area.glb");
};

TEST_F(TrialsTest, RenderEachSeed) {
    const std::optional<Trials> trials = render(small("photons", 2000));
    ASSERT_TRUE(trials);
    ASSERT_EQ(trials->trials.size(), 2u);
    const std::unique_ptr<Device> device = open_device();
    RenderSettings settings = small("photons", 2000);
    for (std::size_t i = 0; i < 2; ++i) {
        settings.seed = static_cast<std::uint32_t>(3 + i);
        const RenderResult expected =
            argand::render(*device, scene_, settings, [](double) { return true; });
        EXPECT_EQ(trials->trials[i].picture.pixels, expected.layers[0].image.pixels);
        EXPECT_GT(trials->trials[i].wall_seconds, 0);
        if (trials->trials[i].device_seconds) {
            EXPECT_GT(*trials->trials[i].device_seconds, 0);
            EXPECT_LT(*trials->trials[i].device_seconds, trials->trials[i].wall_seconds);
        }
    }
}

TEST_F(TrialsTest, CountTheMemoryOfOneSettingAlone) {
    const std::uint64_t few = render(small("photons", 2000))->peak_bytes;
    EXPECT_GT(render(small("photons", 200'000))->peak_bytes, few);
    EXPECT_EQ(render(small("photons", 2000))->peak_bytes, few);
}

TEST_F(TrialsTest, ZeroPhotons) {
    const std::optional<Trials> trials = render(small("footprints", 0));
    ASSERT_TRUE(trials);
    EXPECT_EQ(trials->trials[0].statistics.photons_emitted, 0u);
}

TEST_F(TrialsTest, CanBeInterrupted) {
    EXPECT_FALSE(render(small("path", 0), [] { return false; }));
    int asked = 0;
    EXPECT_FALSE(render(small("path", 0), [&] { return ++asked < 4; }));
}

} // namespace
} // namespace argand
