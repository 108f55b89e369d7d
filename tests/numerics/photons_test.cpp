// Few and many photons, small and large radii.
#include "extremes.hpp"

#include "scene/light_power.hpp"

namespace argand::testing {
namespace {

const char* const map_methods[] = {"photons", "footprints", "knn"};

TEST_F(Extremes, ZeroOneAndTwoPhotons) {
    const Scene scene = load_asset("cornell_point.glb");
    const double power = emitted_power(scene.lights.at(0)).g;
    Largest worst;
    for (const std::string method : map_methods) {
        RenderSettings settings = small(method);
        settings.photons = 0;
        const RenderResult none = sound(scene, settings);
        EXPECT_EQ(mean(layer(none, "indirect")) + mean(layer(none, "caustic")), glm::dvec3(0));
        for (const std::uint64_t photons : {1u, 2u}) {
            settings.photons = photons;
            const RenderResult few = sound(scene, settings);
            EXPECT_TRUE(same_bits(layer(few, "direct"), layer(none, "direct")));
            // One photon carries all of the light's power; each of two carries half.
            const FluxSums& flux = few.statistics.flux;
            const double emitted = static_cast<double>(flux.emitted[1]) * flux.unit;
            EXPECT_RELATIVE(emitted, power, 1e-5) << method << ", photons " << photons;
            worst.take(std::abs(emitted / power - 1), fmt::format("{}, {}", method, photons));
        }
    }
    record_extreme(
        "0, 1 and 2 photons, all methods",
        "0: no indirect light; 1 and 2: the emitted flux is the light's power within 10^-5 (the "
        "picture is noise; the map's sum has a test of its own, below); direct light the same bits",
        "the same bits; power off by " + worst.text());
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

TEST_F(Extremes, RadiusNearZero) {
    const Scene scene = room_scene();
    for (const std::string method : {"photons", "knn"}) {
        RenderSettings settings = small(method);
        const RenderResult usual = sound(scene, settings);
        for (const double radius : {1e-20, 1e-6, 1e-3}) {
            settings.radius = radius;
            const RenderResult found = sound(scene, settings);
            EXPECT_TRUE(same_bits(layer(found, "direct"), layer(usual, "direct")));
            // At 10^-3 of the scene, some discs contain one of the 5,000 photons.
            if (radius < 1e-4) {
                EXPECT_EQ(mean(layer(found, "indirect")), glm::dvec3(0))
                    << method << ", radius " << radius;
            }
        }
    }
    record_extreme("radius → 0 (10^-20, 10^-6, 10^-3)",
                   "finite; direct light the same bits; no photon is found at 10^-20 and 10^-6, a "
                   "few at 10^-3 (noise)",
                   "as expected");
}

TEST_F(Extremes, RadiusAsLargeAsTheScene) {
    // Every wall is lit evenly, so blurring changes nothing. The part of the disc off the wall is
    // known; where less than a tenth lies on it, paths go on instead.
    const double reflected = 0.5;
    Scene scene = box_scene(emitter(glm::vec3(1), glm::vec3(reflected)));
    scene.cameras = {parallel_rays({0, 0, 0}, {0, 0, -1}, 0.01f)};
    RenderSettings settings = small("photons", 16, 8);
    settings.photons = 100'000;
    // Large discs are known from few area samples, of which each pass takes others.
    settings.photons_per_pass = 12'500;
    std::string figures;
    // Relative to the emitted radiance, after two and more scatterings.
    const double expected = reflected * reflected / (1 - reflected);
    for (const double radius : {2.0, 10.0}) { // 1 and 5 scene sizes
        settings.radius = radius;
        const double found = mean(layer(sound(scene, settings), "indirect")).g;
        EXPECT_RELATIVE(found, expected, 0.03) << "radius " << radius;
        figures +=
            fmt::format("{}{} of {}", figures.empty() ? "" : "; ", shown(found), shown(expected));
    }
    record_extreme("radius → scene (1, 5 scene sizes), photons",
                   "evenly lit walls: indirect light within 3 %", figures);
    for (const double radius : {2.0, 10.0}) {
        RenderSettings nearest = small("knn");
        nearest.radius = radius;
        sound(room_scene(), nearest);
    }
    record_extreme("radius → scene (1, 5 scene sizes), knn",
                   "finite (the k nearest limit the disc long before)", "finite");
}

TEST_F(Extremes, FootprintsFromZeroToTheSizeOfTheScene) {
    const Scene scene = room_scene();
    RenderSettings settings = small("footprints");
    const RenderResult usual = sound(scene, settings);
    for (const double smoothing : {1e-12, 1e-3, 1e3, 1e12}) {
        settings.footprints.smoothing = smoothing;
        EXPECT_TRUE(same_bits(layer(sound(scene, settings), "direct"), layer(usual, "direct")));
    }
    record_extreme("smoothing of footprints 10^-12 … 10^12", "finite; direct light the same bits",
                   "holds");
}

TEST_F(Extremes, SlowAThousandBouncesBetweenWhiteWalls) {
    Scene scene = box_scene(emitter(glm::vec3(1), glm::vec3(1)));
    // Sees so much of the box that no photons are aimed at what is in view: roulette thins them
    // out.
    scene.cameras = {look_at({0, 0, 0.9f}, {0, 0, -1}, 90)};
    Largest cut;
    double least = HUGE_VAL;
    for (const std::string& method : exact_methods()) {
        RenderSettings settings = small(method, 2, 8);
        settings.photons = 500;
        settings.bounces = 1000;
        const RenderResult result = sound(scene, settings);
        // The expectation over all renders is 1002, but no single render shows it: Russian roulette
        // leaves the later bounces to few, very bright paths. Photons are exempt from roulette for
        // 64 bounces.
        const double found = mean(layer(result, "")).g;
        EXPECT_GT(found, has_map(method) ? 65 : 40) << method;
        EXPECT_LT(found, 2 * 1002) << method;
        least = std::min(least, found);
        if (has_map(method)) {
            const FluxSums& flux = result.statistics.flux;
            EXPECT_EQ(flux.escaped[1], 0);
            const double absorbed =
                static_cast<double>(flux.absorbed[1]) / static_cast<double>(flux.emitted[1]);
            cut.take(std::abs(absorbed), method);
        }
    }
    record_extreme("albedo 1, 1,000 bounces",
                   "ends, finite; nothing escapes; between 40 (path) or 65 and 2,004 times the "
                   "emitted radiance (the mean is 1,002, which takes more paths; see 30 bounces)",
                   fmt::format("at least {}; absorbed by roulette, over emitted: {}", shown(least),
                               cut.text()));
}

TEST_F(Extremes, ThirtyBouncesBetweenWhiteWalls) {
    const Scene scene = box_scene(emitter(glm::vec3(1), glm::vec3(1)));
    Largest worst;
    for (const std::string& method : exact_methods()) {
        RenderSettings settings = small(method, has_map(method) ? 4 : 128, 8);
        settings.bounces = 30;
        // The emitted radiance, and as much again for the bounce at the first vertex and for each
        // before it.
        const double found = mean(layer(sound(scene, settings), "")).g;
        EXPECT_RELATIVE(found, 32.0, 0.06) << method;
        worst.take(std::abs(found / 32 - 1), method);
    }
    record_extreme("albedo 1, 30 bounces",
                   "32 times the emitted radiance within 6 % (8,192 paths, 5,000 photons)",
                   worst.text());
}

} // namespace
} // namespace argand::testing
