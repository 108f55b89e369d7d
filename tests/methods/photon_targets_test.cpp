// Photons are aimed at small objects that throw caustics into view, which few would hit otherwise.
#include "methods/photon_targets.hpp"

#include "rendering.hpp"
#include "scene/gltf.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

namespace argand::testing {
namespace {

using ::testing::SizeIs;

/// A glass block of 4 cm on the floor of a room of 6 m, seen from near.
Scene block_in_a_room() {
    Scene scene;
    const std::uint32_t white = add_material(scene, lambertian({0.7f, 0.6f, 0.5f}));
    const std::uint32_t lamp = add_material(scene, emitter(glm::vec3(2.5f)));
    const std::uint32_t clear = add_material(scene, glass(1.5f, true));
    add_box(scene, {-3, 0, -3}, {3, 2.8f, 3}, white, true);
    add_quad(scene, {-0.6f, 2.7f, -1.6f}, {2, 0, 0}, {0, 0, 2}, lamp);
    add_box(scene, {-0.02f, 0.001f, -0.02f}, {0.02f, 0.041f, 0.02f}, clear, false);
    scene.cameras = {look_at({0.02f, 0.13f, 0.15f}, {-0.01f, 0, 0}, 45)};
    return scene;
}

/// A hall of 60 m with one lamp, and a close-up of a chest in its corner.
Scene corner_of_a_hall() {
    Scene scene;
    const std::uint32_t white = add_material(scene, lambertian({0.7f, 0.7f, 0.7f}));
    add_box(scene, {-30, 0, -30}, {30, 12, 30}, white, true);
    add_box(scene, {-29.5f, -0.01f, -29.3f}, {-28.3f, 0.7f, -28.6f}, white, false);
    scene.lights = {point_light({8, 9, 5}, glm::vec3(1500))};
    scene.cameras = {look_at({-26.9f, 1.5f, -26.9f}, {-29.4f, 0.5f, -29.4f}, 60)};
    return scene;
}

class PhotonTargets : public EveryMethod {
protected:
    RenderSettings settings() const {
        RenderSettings settings = settings_of(GetParam(), 16, 16);
        settings.photons = 100'000;
        return settings;
    }

    /// The same for all methods.
    const RenderResult& truth() {
        RenderSettings s = settings();
        s.method = "path";
        s.samples = 2048;
        s.seed = 1;
        return render_once("block", block_in_a_room(), s);
    }

    /// Compares the indirect light of pictures of the hall with that of `path`. One photon in a
    /// hundred gets into view if none are aimed: the mean of a picture is then off by 6 % to 12 %
    /// (standard deviation over seeds).
    void expect_light_of_hall(const Scene& hall, const std::string& name) {
        RenderSettings s = settings_of(GetParam(), 16, 16);
        s.photons = 200'000;
        RenderSettings reference = settings_of("path", 16, 4096);
        reference.seed = 100;
        const double truth = mean(layer(render_once(name, hall, reference), "indirect")).g;
        double squares = 0;
        double sum = 0;
        constexpr int seeds = 4;
        for (int seed = 0; seed < seeds; ++seed) {
            s.seed = static_cast<std::uint32_t>(seed);
            const RenderResult found = render(hall, s);
            if (found.statistics.photons_emitted == 0) {
                return; // the truth's own method
            }
            const double share = mean(layer(found, "indirect")).g / truth;
            sum += share / seeds;
            squares += (share - 1) * (share - 1) / seeds;
            const FluxSums& flux = found.statistics.flux;
            EXPECT_RELATIVE(static_cast<double>(flux.emitted[1]) * flux.unit, 4 * double(pi) * 1500,
                            0.02);
            EXPECT_EQ(flux.emitted[1],
                      flux.absorbed[1] + flux.escaped[1] + flux.cut[1] + flux.lost[1]);
        }
        const bool aims = GetParam() != "knn"; // which needs photons of about equal flux
        EXPECT_NEAR(sum, 1, aims ? 0.04 : 0.1);
        EXPECT_LT(std::sqrt(squares), aims ? 0.045 : 0.15);
    }
};

// One photon in 20,000 hits the block if none are aimed.
TEST_P(PhotonTargets, ASmallBlockThrowsItsCaustic) {
    RenderSettings s = settings();
    const RenderResult found = render(block_in_a_room(), s);
    if (found.statistics.photons_emitted == 0) {
        return; // the truth's own method
    }
    const double caustic = mean(layer(truth(), "caustic")).g;
    EXPECT_RELATIVE(mean(layer(found, "caustic")).g, caustic, 0.3);
    // Two to four times the mean if none are aimed.
    s.seed = 1;
    const RenderResult other = render(block_in_a_room(), s);
    EXPECT_LT(compare(layer(found, "caustic"), layer(other, "caustic")).rmse, caustic);
    const double power = double(pi) * 4 * 2.5;
    EXPECT_RELATIVE(static_cast<double>(found.statistics.flux.emitted[1]) *
                        found.statistics.flux.unit,
                    power, 0.02);
}

// The same photons, so that their noise cancels. Estimates that reach for the caustic from all
// around it spread its light, and add to it.
TEST_P(PhotonTargets, EstimatorsKeepTheCausticsLight) {
    const Scene scene = load_gltf(ARGAND_SOURCE_DIR "/assets/glass_marble.glb");
    const RenderResult found = render(scene, settings());
    if (found.statistics.photons_emitted == 0) {
        return; // no estimator
    }
    RenderSettings s = settings();
    s.method = "photons";
    const RenderResult discs = render_once("marble, photons", scene, s);
    EXPECT_RELATIVE(mean(layer(found, "caustic")).g, mean(layer(discs, "caustic")).g, 0.2);
}

TEST_P(PhotonTargets, SlowACloseUpInAHallHasItsLight) {
    expect_light_of_hall(corner_of_a_hall(), "hall");
}

// A mirror shows a little of what lies elsewhere.
TEST_P(PhotonTargets, SlowACloseUpWithAMirrorHasItsLight) {
    Scene hall = corner_of_a_hall();
    add_box(hall, {-29.1f, 0.71f, -29.1f}, {-28.9f, 0.9f, -28.9f}, add_material(hall, mirror()),
            false);
    expect_light_of_hall(hall, "hall with a mirror");
}

// A single photon passes the veil: the distance to its nearest is 0, which is no radius. render()
// expects finite samples.
TEST_P(PhotonTargets, ASingleCausticPhotonHasNoRadiusOfItsOwn) {
    RenderSettings s = settings_of(GetParam(), 8, 1);
    s.photons = 200;
    const RenderStatistics found = render(load_asset("veil.glb"), s).statistics;
    EXPECT_EQ(found.caustic_radius, found.radius);
}

INSTANTIATE_QUICK_AND_SLOW(PhotonTargets, "footprints", estimates);

} // namespace
} // namespace argand::testing
