// Few photons and many, small discs and large ones.
#include "extremes.hpp"

#include "scene/light_power.hpp"

namespace argand::testing {
namespace {

const char* const map_methods[] = {"photons", "footprints", "knn"};

TEST_F(Extremes, NoPhotonOneAndTwo) {
    const Scene scene = load_asset("cornell_glass.glb");
    for (const std::string method : map_methods) {
        RenderSettings settings = small(method);
        settings.photons = 0;
        const RenderResult none = sound(scene, settings);
        EXPECT_EQ(mean(layer(none, "indirect")) + mean(layer(none, "caustic")), glm::dvec3(0));
        for (const std::uint64_t photons : {1u, 2u}) {
            settings.photons = photons;
            const RenderResult few = sound(scene, settings);
            EXPECT_TRUE(same_bits(layer(few, "direct"), layer(none, "direct")));
        }
    }
    record_extreme("0, 1 and 2 photons, all methods",
                   "no indirect light, or little; direct light the same bits", "the same bits");
}

TEST_F(Extremes, SlowTenMillionPhotons) {
    const Scene scene = load_asset("cornell_point.glb");
    RenderSettings settings = small("photons", 1, 8);
    settings.photons = 10'000'000;
    const RenderResult result = sound(scene, settings);
    const FluxSums& flux = result.statistics.flux;
    const glm::dvec3 power = emitted_power(scene.lights.at(0));
    const double emitted = static_cast<double>(flux.emitted[1]) * flux.unit;
    EXPECT_RELATIVE(emitted, power.g, 1e-4);
    settings.photons = 200'000;
    settings.samples = 32;
    const double error = difference_of_means(result, sound(scene, settings));
    EXPECT_LT(error, 0.05);
    record_extreme("10^7 photons",
                   "all emitted; flux balances to the unit; the mean within 5 % of that of 200,000",
                   fmt::format("{} passes, power off by {}, mean by {}", result.statistics.passes,
                               shown(std::abs(emitted / power.g - 1)), shown(error)));
}

TEST_F(Extremes, RadiusFromNothingToTheScene) {
    const Scene scene = room_scene(); // 2 wide
    Largest blur;
    for (const std::string method : {"photons", "knn"}) {
        RenderSettings settings = small(method);
        const RenderResult usual = sound(scene, settings);
        for (const double radius : {1e-20, 1e-6, 1e-3}) {
            settings.radius = radius;
            const RenderResult found = sound(scene, settings);
            EXPECT_TRUE(same_bits(layer(found, "direct"), layer(usual, "direct")));
        }
        for (const double radius : {2.0, 10.0}) {
            settings.radius = radius;
            const RenderResult found = sound(scene, settings);
            const double error = difference_of_means(found, usual, "indirect");
            EXPECT_LT(error, 0.9) << method << ", " << radius;
            blur.take(error, fmt::format("{}, {} sizes", method, radius / 2));
        }
    }
    record_extreme("radius → 0 (10^-20, 10^-6, 10^-3) and → scene (1, 5 scene sizes)",
                   "finite; small: direct light the same bits; large: indirect light blurred and, where "
                   "surfaces cover little "
                   "of the disc, darker, its mean by less than 90 %",
                   blur.text());
}

TEST_F(Extremes, FootprintsFromNothingToTheScene) {
    const Scene scene = room_scene();
    RenderSettings settings = small("footprints");
    const RenderResult usual = sound(scene, settings);
    for (const double smoothing : {1e-12, 1e-3, 1e3, 1e12}) {
        settings.footprints.smoothing = smoothing;
        EXPECT_TRUE(same_bits(layer(sound(scene, settings), "direct"), layer(usual, "direct")));
    }
    record_extreme("smoothing of footprints 10^-12 … 10^12", "finite; direct light the same bits", "holds");
}

TEST_F(Extremes, AThousandBouncesBetweenWhiteWalls) {
    const Scene scene = box_scene(emitter(glm::vec3(1), glm::vec3(1)));
    Largest cut;
    for (const std::string& method : method_names()) {
        RenderSettings settings = small(method, 2, 8);
        settings.photons = 500;
        settings.bounces = 1000;
        const RenderResult result = sound(scene, settings);
        // Every bounce adds 1; roulette from the 64th on makes what comes later rare and bright.
        EXPECT_GT(mean(layer(result, "")).g, 30) << method;
        if (method != "path") {
            const FluxSums& flux = result.statistics.flux;
            EXPECT_EQ(flux.escaped[1], 0);
            const double absorbed =
                static_cast<double>(flux.absorbed[1]) / static_cast<double>(flux.emitted[1]);
            cut.take(std::abs(absorbed), method);
        }
    }
    record_extreme("albedo 1, 1,000 bounces",
                   "ends, finite, at least 30 of the emitted radiance; nothing escapes",
                   "absorbed by roulette, over what is emitted: " + cut.text());
}

} // namespace
} // namespace argand::testing
