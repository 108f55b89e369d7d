// Light of nearby surfaces that eye paths follow instead of taking it from the photon map.
#include "rendering.hpp"

namespace argand::testing {
namespace {

class NearField : public EveryMethod {
protected:
    RenderSettings settings(std::optional<double> distance) const {
        RenderSettings settings = settings_of(GetParam(), 16, 64);
        settings.photons = 100'000;
        settings.near_field = distance;
        return settings;
    }

    const RenderResult& truth(const Scene& scene, std::uint32_t samples) {
        return render_once(scene.name, scene, settings_of("path", 16, samples));
    }
};

// With half a metre, a quarter of the box, much of the light is followed. Light must count once:
// by way of glass, through partly absent surfaces, and at any bounce.
TEST_P(NearField, EachLayerHasTheLightOfPathTracing) {
    const Scene glass = load_asset("cornell_glass.glb"), leaves = load_asset("cutouts.glb");
    const RenderResult of_glass = render(glass, settings(0.5)),
                       of_leaves = render(leaves, settings(0.5));
    EXPECT_EQ(of_glass.statistics.near_field, 0.5);
    expect_same_layers(of_glass, truth(glass, 1024), 0.04, 0.15);
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_RELATIVE(mean(layer(of_leaves, "indirect"))[channel],
                        mean(layer(truth(leaves, 1024), "indirect"))[channel], 0.04);
    }
}

// Caustics behind a second estimated vertex are in the map, and paths must not find them again. All
// light of the bulb's lamp is a caustic first.
TEST_P(NearField, SlowCausticsBehindSecondVerticesCountOnce) {
    const Scene bulb = load_asset("bulb.glb"), glass = load_asset("frosted_glass.glb");
    for (const bool gathers : {false, true}) {
        SCOPED_TRACE(gathers);
        RenderSettings everything = settings(100);
        everything.final_gather = gathers;
        EXPECT_RELATIVE(mean(layer(render(bulb, everything), "indirect")).g,
                        mean(layer(truth(bulb, 2048), "indirect")).g, 0.06);
        EXPECT_RELATIVE(mean(layer(render(glass, everything), "indirect")).g,
                        mean(layer(truth(glass, 1024), "indirect")).g, 0.06);
    }
}

TEST_P(NearField, CountsBounces) {
    const Scene scene = room_scene();
    for (const std::uint32_t bounces : {1u, 2u}) {
        RenderSettings limited = settings(0.5), by_paths = settings_of("path", 16, 512);
        limited.bounces = by_paths.bounces = bounces;
        const double found = mean(layer(render(scene, limited), "indirect")).g;
        EXPECT_RELATIVE(found, mean(layer(render(scene, by_paths), "indirect")).g, 0.03) << bounces;
    }
}

TEST_P(NearField, IsLearntWhereSurfacesLieClose) {
    const Scene sheets = room_with_sheets();
    const RenderResult found = render(sheets, settings({}));
    EXPECT_GT(found.statistics.near_field, 0.001);
    EXPECT_LT(found.statistics.near_field, 0.01);
    const RenderResult without = render(sheets, settings(0));
    EXPECT_EQ(without.statistics.near_field, 0);
    EXPECT_LT(found.statistics.photons_stored, without.statistics.photons_stored);
    const glm::dvec3 expected = mean(layer(truth(sheets, 1024), "indirect"));
    EXPECT_RELATIVE(mean(layer(found, "indirect")).g, expected.g, 0.03);
    EXPECT_EQ(render(room_scene(), settings({})).statistics.near_field, 0);
}

// Without paths that go on there is nothing that could follow light.
TEST_P(NearField, NeedsPathsThatGoOn) {
    RenderSettings all_taken = settings(0.5);
    all_taken.least_coverage = 0;
    EXPECT_EQ(render(room_scene(), all_taken).statistics.near_field, 0);
    RenderSettings no_photons = settings(0.5);
    no_photons.photons = 0;
    const RenderResult found = render(room_scene(), no_photons);
    EXPECT_EQ(found.statistics.near_field, 0);
    EXPECT_EQ(mean(layer(found, "indirect")), glm::dvec3(0));
}

INSTANTIATE_QUICK_AND_SLOW(NearField, "photons", without(estimates, "path"));

} // namespace
} // namespace argand::testing
