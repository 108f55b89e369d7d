// Motion blur: an image is the mean of the moments while the shutter is open.
#include "moving_scene.hpp"
#include "rendering.hpp"
#include "session/shutter.hpp"
#include "world/world.hpp"

#include <algorithm>
#include <vector>

namespace argand::testing {
namespace {

bool always(double /*share*/) { return true; }

TEST(Shutter, HasAMomentInEveryPartOfItsTime) {
    const Shutter shutter{.open = 2, .close = 6};
    for (const std::uint32_t seed : {0u, 1u, 0xffffffffu}) {
        for (const std::uint64_t passes : {1u, 2u, 16u, 256u}) {
            std::vector<int> moments_in(passes, 0);
            for (std::uint64_t pass = 0; pass < passes; ++pass) {
                const double share = (moment_of(shutter, pass, seed) - 2) / 4;
                ASSERT_GT(share, 0);
                ASSERT_LT(share, 1);
                ++moments_in[static_cast<std::size_t>(share * static_cast<double>(passes))];
            }
            EXPECT_EQ(std::count(moments_in.begin(), moments_in.end(), 1),
                      static_cast<std::ptrdiff_t>(passes));
        }
    }
}

TEST(Shutter, HasMomentsWithoutBias) {
    // Over all seeds the moments of every pass are even over the time, not only those of them all.
    for (const std::uint64_t pass : {0u, 1u, 2u, 1000u}) {
        double sum = 0, squares = 0;
        constexpr int seeds = 20'000;
        for (std::uint32_t seed = 0; seed < seeds; ++seed) {
            const double moment = moment_of({0, 1}, pass, seed);
            sum += moment;
            squares += moment * moment;
        }
        EXPECT_NEAR(sum / seeds, 0.5, 0.01) << pass;
        EXPECT_NEAR(squares / seeds, 1.0 / 3, 0.01) << pass;
    }
}

class OpenShutter : public EveryMethod {
protected:
    RenderResult render_through(Scene scene, const RenderSettings& settings,
                                const Shutter& shutter) {
        World world(device(), scene);
        const RenderSettings spread = with_pass_per_sample(settings);
        Session session(world, scene, spread);
        return argand::render_through(session, world, scene, shutter, settings.seed, always);
    }
};

TEST_P(OpenShutter, ShowsTheMeanOfTheMoments) {
    RenderSettings settings = settings_of(GetParam(), 12, has_map(GetParam()) ? 32 : 256);
    settings.photons = 32'000;
    Scene scene = moving_scene();
    const RenderResult blurred = render_through(scene, settings, {0, 1});
    EXPECT_EQ(blurred.statistics.passes, settings.samples);
    EXPECT_EQ(blurred.statistics.samples, settings.samples);
    // A light path for each sample of the 12 x 12 pixels, with these.
    const std::uint64_t light_paths = has_light_paths(GetParam()) ? 144u * settings.samples : 0u;
    EXPECT_EQ(blurred.statistics.photons_emitted, has_map(GetParam()) ? 32'000u : light_paths);
    // Each moment has as many photons, so that radii are of the same size.
    constexpr int moments = 8;
    settings.samples /= 4;
    std::vector<RenderResult> results;
    for (int i = 0; i < moments; ++i) {
        move_to((i + 0.5) / moments, scene);
        results.push_back(render(scene, settings));
    }
    RenderResult mean_of_moments = results.front();
    for (std::size_t l = 0; l < mean_of_moments.layers.size(); ++l) {
        std::vector<glm::vec3>& pixels = mean_of_moments.layers[l].image.pixels;
        for (std::size_t p = 0; p < pixels.size(); ++p) {
            glm::dvec3 sum(0);
            for (const RenderResult& result : results) {
                sum += result.layers[l].image.pixels[p];
            }
            pixels[p] = sum / double(moments);
        }
    }
    // Paths find too seldom what a light beside a surface lights indirectly.
    for (const char* name : {"direct", has_map(GetParam()) ? "indirect" : "direct"}) {
        const glm::dvec3 found = mean(layer(blurred, name)),
                         expected = mean(layer(mean_of_moments, name));
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_RELATIVE(found[channel], expected[channel], 0.06) << name << ", " << channel;
        }
    }
    const auto error_of = [&](const RenderResult& result) {
        return compare(layer(result, "direct"), layer(mean_of_moments, "direct")).rel_mse;
    };
    EXPECT_LT(error_of(blurred), 0.1 * error_of(results[moments / 2]));
}

TEST_P(OpenShutter, OfASceneThatRestsShowsTheSceneAtRest) {
    RenderSettings settings = settings_of(GetParam(), 12, 4);
    settings.photons = 4'000;
    const Scene scene = load_asset("cornell_glass.glb");
    EXPECT_TRUE(same_bits(render_through(scene, settings, {0, 1}),
                          render(scene, with_pass_per_sample(settings))));
}

TEST_P(OpenShutter, SeesALightThatIsSwitchedOn) {
    // At first the scene requires no direct light and no photons.
    RenderSettings settings = settings_of(GetParam(), 8, 4);
    settings.photons = 4'000;
    settings.photons_per_pass = 1'000;
    settings.samples_per_pass = 1;
    settings.least_passes = keeps_photons(GetParam()) ? 4 : 1;
    Scene scene = moving_scene();
    const std::vector<Light> lights = scene.lights;
    const std::vector<Material> materials = scene.materials;
    scene.motion.lights.clear();
    scene.lights.clear();
    for (Material& material : scene.materials) {
        material.emission = glm::vec3(0);
    }
    scene.sky.reset();
    World world(device(), scene);
    Session session(world, scene, settings);
    session.begin_frame(0);
    EXPECT_TRUE(session.step(session.next_pass().value(), always));
    EXPECT_EQ(mean(session.layers()[0].image).x, 0);
    scene.lights = lights;
    for (int pass = 1; pass < 4; ++pass) {
        session.follow();
        EXPECT_TRUE(session.step(session.next_pass().value(), always));
    }
    EXPECT_FALSE(session.next_pass());
    const RenderResult result = session.result();
    EXPECT_EQ(result.statistics.samples, 4u);
    EXPECT_GT(mean(layer(result, "direct")).x, 0);
    EXPECT_GT(mean(layer(result, "indirect")).x, 0);
}

INSTANTIATE_METHODS(OpenShutter);

} // namespace
} // namespace argand::testing
