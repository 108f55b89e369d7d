// Light paths and eye paths together find the light that path tracing finds, layer by layer, and
// the caustics of delta lights, which it cannot find.
#include "rendering.hpp"

#include <cmath>

namespace argand::testing {
namespace {

class Bidirectional : public RenderTest {
protected:
    static RenderSettings settings(int size, std::uint32_t samples, const std::string& per_sample) {
        RenderSettings s = settings_of("bidirectional", size, samples);
        s.own["light-paths"] = per_sample;
        return s;
    }

    /// Expects the layers' means of both methods to differ by no more than the noise of four seeds
    /// each allows.
    void expect_agreement(const Scene& scene, int size, std::uint32_t samples) {
        const Means eye = means(scene, settings_of("path", size, 3 * samples));
        const Means both = means(scene, settings(size, samples, "1"));
        for (const auto& [name, expected] : eye) {
            const Mean& found = both.at(name);
            const double noise = std::hypot(found.error, expected.error);
            // Of four seeds the error is known to a factor of about 2.
            EXPECT_NEAR(found.value, expected.value, 6 * noise + 2e-3 * expected.value)
                << scene.name << ", " << name;
        }
    }

    double relative_variance(const Scene& scene, RenderSettings s, const std::string& name) {
        std::vector<Image> images;
        for (s.seed = 1; s.seed <= 2; ++s.seed) {
            images.push_back(layer(render(scene, s), name));
        }
        return rel_variance(images, images[0], images[1]);
    }

private:
    struct Mean {
        double value, error;
    };
    using Means = std::map<std::string, Mean>;

    Means means(const Scene& scene, RenderSettings s) {
        constexpr int seeds = 4;
        std::map<std::string, std::vector<double>> values;
        for (int seed = 1; seed <= seeds; ++seed) {
            s.seed = static_cast<std::uint32_t>(seed);
            const RenderResult result = render(scene, s);
            for (const char* name : {"direct", "indirect", "caustic"}) {
                const glm::dvec3 m = mean(layer(result, name));
                values[name].push_back((m.x + m.y + m.z) / 3);
            }
        }
        Means found;
        for (const auto& [name, v] : values) {
            double sum = 0, squares = 0;
            for (const double x : v) {
                sum += x;
            }
            for (const double x : v) {
                squares += (x - sum / seeds) * (x - sum / seeds);
            }
            found[name] = {sum / seeds, std::sqrt(squares / (seeds - 1) / seeds)};
        }
        return found;
    }
};

TEST_F(Bidirectional, WithoutLightPathsItIsPathTracing) {
    for (const char* name : {"cornell_glass.glb", "sky_room.glb"}) {
        const Scene scene = load_asset(name);
        const RenderResult eye = render(scene, settings_of("path", 16, 8));
        const RenderResult none = render(scene, settings(16, 8, "0"));
        EXPECT_TRUE(same_bits(eye, none)) << name;
        EXPECT_EQ(none.statistics.photons_emitted, 0u);
        RenderSettings direct = settings(16, 8, "1");
        direct.bounces = 0; // nor does direct light have any
        EXPECT_EQ(render(scene, direct).statistics.photons_emitted, 0u);
    }
}

TEST_F(Bidirectional, AgreesWithPathTracing) {
    expect_agreement(load_asset("cornell_area.glb"), 16, 32);
}

TEST_F(Bidirectional, SlowAgreesWithPathTracingOnEveryKindOfLightAndSurface) {
    for (const char* name :
         {"bulb.glb", "cornell_mirror.glb", "courtyard.glb", "cutouts.glb", "drink.glb",
          "frosted_glass.glb", "inside_glass.glb", "sky_room.glb", "smooth_sphere.glb", "spot.glb",
          "textures.glb", "varnish.glb", "veil.glb"}) {
        expect_agreement(load_asset(name), 12, 32);
    }
}

TEST_F(Bidirectional, AgreesWithPathTracingThroughEveryCamera) {
    Scene scene = room_scene();
    Camera& camera = scene.cameras.front();
    RenderSettings eye = settings_of("path", 16, 192);
    RenderSettings both = settings(16, 64, "1");
    for (const bool lens : {false, true}) {
        for (const CameraKind kind : {CameraKind::perspective, CameraKind::orthographic}) {
            camera.kind = kind;
            camera.vertical_extent = 0.5f;
            eye.aperture = both.aperture = lens ? 0.2 : 0;
            eye.focus = both.focus = 1;
            const RenderResult expected = render(scene, eye);
            EXPECT_GT(mean(layer(expected, "indirect")).g, 0);
            expect_same_layers(render(scene, both), expected, 0.03);
        }
    }
}

TEST_F(Bidirectional, FindsCausticsOfPointLightsWhichEyePathsCannot) {
    // A ball of glass over the floor gathers the light of a lamp. The camera looks at the floor
    // below it.
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 3);
    add_sphere(scene, {0, 1, 0}, 0.4f, 16, true, add_material(scene, glass(1.5f, true)));
    scene.lights = {point_light({0.1f, 3, 0}, glm::vec3(5))};
    scene.cameras = {parallel_rays({0, 0.4f, 1.5f}, {0, 0, 0}, 0.4f)};
    const RenderResult eye = render(scene, settings_of("path", 12, 32));
    EXPECT_EQ(mean(layer(eye, "caustic")).g, 0);
    RenderSettings photons = settings_of("photons", 12, 16);
    photons.photons = 400'000;
    photons.radius = 0.01;
    const double expected = mean(layer(render(scene, photons), "caustic")).g;
    EXPECT_GT(expected, 0.02);
    // As many as make the noise small: few of the light's photons hit the ball.
    EXPECT_RELATIVE(mean(layer(render(scene, settings(12, 32, "50")), "caustic")).g, expected,
                    0.03);
}

TEST_F(Bidirectional, TheSunInAMirrorIsACaustic) {
    // A mirror at 45° reflects the sun's horizontal light straight down.
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 3);
    add_quad(scene, {-1, 1, -1}, {0, 2, 2}, {2, 0, 0}, add_material(scene, mirror()));
    scene.lights = {directional_light({0, 0, -1}, glm::vec3(1))};
    scene.cameras = {parallel_rays({0, 0.6f, 4}, {0, 0, 0}, 0.1f)};
    const RenderResult result = render(scene, settings(8, 16, "200"));
    constexpr double pi = 3.14159265358979323846;
    EXPECT_RELATIVE(mean(layer(result, "caustic")).g, 0.5 / pi, 0.03);
    EXPECT_EQ(mean(layer(result, "direct")).g, 0);
}

TEST_F(Bidirectional, HasLessNoiseThanEyePaths) {
    const Scene scene = load_asset("cornell_point.glb");
    const double eye = relative_variance(scene, settings_of("path", 24, 16), "indirect");
    EXPECT_LT(relative_variance(scene, settings(24, 16, "1"), "indirect"), 0.75 * eye);
    EXPECT_LT(relative_variance(scene, settings(24, 16, "8"), "indirect"), 0.4 * eye);
}

TEST_F(Bidirectional, APartOfAnImageHasTheBitsOfTheWhole) {
    const Scene scene = load_asset("cornell_glass.glb");
    RenderSettings s = settings(16, 4, "2");
    const RenderResult whole = render(scene, s);
    s.crop = CropRectangle{5, 3, 14, 12};
    const RenderResult part = render(scene, s);
    for (const char* name : {"direct", "indirect", "caustic"}) {
        const Image& all = layer(whole, name);
        const Image& some = layer(part, name);
        for (int y = 0; y < some.height; ++y) {
            for (int x = 0; x < some.width; ++x) {
                const auto at = static_cast<std::size_t>((y + 3) * all.width + x + 5);
                ASSERT_EQ(some.pixels[static_cast<std::size_t>(y * some.width + x)],
                          all.pixels[at]);
            }
        }
    }
}

TEST_F(Bidirectional, EverythingChangesNoBit) {
    for (const char* name : {"cornell_point.glb", "cornell_glass.glb"}) {
        const Scene scene = load_asset(name);
        RenderSettings s = settings(8, 4, "2");
        const RenderResult special = render(scene, s);
        s.everything = true;
        EXPECT_TRUE(same_bits(render(scene, s), special)) << name;
    }
}

TEST_F(Bidirectional, OnePixelTakesMorePhotonsThanALoopMayHave) {
    // Lavapipe ends loops after 65,535 iterations, and all splats of a pixel are added in one.
    const Scene scene = load_asset("cornell_point.glb");
    RenderSettings s = settings(1, 100, "1000");
    const RenderResult found = render(scene, s);
    EXPECT_EQ(found.statistics.photons_emitted, 100'000u);
    const RenderResult expected = render(scene, settings_of("path", 1, 20'000));
    EXPECT_RELATIVE(mean(layer(found, "indirect")).g, mean(layer(expected, "indirect")).g, 0.03);
}

TEST_F(Bidirectional, PassesOfSmallImagesFillADevice) {
    const auto passes = [&](int size, std::uint32_t samples) {
        return render(room_scene(), settings_of("bidirectional", size, samples)).statistics.passes;
    };
    EXPECT_EQ(passes(8, 1024), 1u); // 65,536 eye paths
    EXPECT_EQ(passes(8, 1025), 2u);
    EXPECT_EQ(passes(72, 17), 2u); // a larger image has 16 samples in a pass
}

TEST_F(Bidirectional, AnInterruptedPassCountsLikeOthers) {
    const Scene scene = load_asset("cornell_point.glb");
    // More samples than a processor traces together, so that the pass may end before its last one.
    RenderSettings s = settings(96, 16, "1");
    const RenderResult whole = render(scene, s);
    int calls = 0;
    const RenderResult part =
        argand::render(device(), scene, s, [&](double) { return ++calls < 1; });
    EXPECT_TRUE(part.statistics.interrupted);
    if (device().info().lane_serial()) {
        EXPECT_LT(part.statistics.samples, whole.statistics.samples);
    }
    expect_same_layers(part, whole, 0.03);
}

TEST_F(Bidirectional, FluxBalances) {
    const RenderResult result = render(load_asset("cornell_glass.glb"), settings(16, 16, "1"));
    const FluxSums& flux = result.statistics.flux;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        EXPECT_GT(flux.emitted[channel], 0);
        EXPECT_EQ(flux.emitted[channel], flux.absorbed[channel] + flux.escaped[channel] +
                                             flux.cut[channel] + flux.lost[channel]);
    }
}

} // namespace
} // namespace argand::testing
