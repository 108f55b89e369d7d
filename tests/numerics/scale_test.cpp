// Large and small, distant, bright and dark scenes.
#include "extremes.hpp"

namespace argand::testing {
namespace {

const char* const scene_names[] = {"cornell_glass.glb", "courtyard.glb"};

Scene moved(Scene scene, glm::vec3 by) {
    for (glm::vec3& p : scene.positions) {
        p += by;
    }
    for (Light& light : scene.lights) {
        light.position += by;
    }
    for (Camera& camera : scene.cameras) {
        camera.position += by;
    }
    return scene;
}

Scene brighter(Scene scene, float factor) {
    for (Light& light : scene.lights) {
        light.intensity *= factor;
    }
    for (Material& material : scene.materials) {
        material.emission *= factor;
    }
    if (scene.sky) {
        *scene.sky *= factor;
    }
    return scene;
}

RenderResult darker(RenderResult result, double factor) {
    for (Layer& part : result.layers) {
        for (glm::vec3& pixel : part.image.pixels) {
            pixel = glm::vec3(glm::dvec3(pixel) / factor);
        }
    }
    return result;
}

TEST_F(Extremes, ScenesAMillionTimesAsLargeOrSmall) {
    Largest worst;
    Largest worst_pixels;
    for (const char* name : scene_names) {
        const Scene scene = load_asset(name);
        for (const std::string& method : exact_methods()) {
            const RenderResult expected = sound(scene, small(method, 8));
            for (const float factor : {1e-6f, 1e6f}) {
                const RenderResult found = sound(scaled(scene, factor), small(method, 8));
                const std::string where = fmt::format("{} {} × {:.0e}", method, name, factor);
                const double error = difference_of_means(found, expected);
                EXPECT_LT(error, 0.02) << where;
                worst.take(error, where);
                const double pixels = difference(found, expected);
                EXPECT_LT(pixels, 2e-3) << where;
                worst_pixels.take(pixels, where);
            }
        }
    }
    record_extreme(
        "scene scaled by 10^±6",
        "same picture: mean within 2 %, relMSE below 0.002 (rounding changes single paths)",
        fmt::format("{}; relMSE {}", worst.text(), worst_pixels.text()));
}

TEST_F(Extremes, ScenesFarFromTheOrigin) {
    const Scene scene = room_scene();
    const double bounds_of_means[] = {0.02, 0.4};
    const double bounds_of_pixels[] = {0.02, 0.3};
    const float sizes[] = {1e3f, 1e5f};
    for (int i = 0; i < 2; ++i) {
        Largest worst;
        Largest worst_pixels;
        // The room's size is 2.
        const Scene far = moved(scene, glm::vec3(1, -0.7f, 0.6f) * (2 * sizes[i]));
        for (const std::string& method : exact_methods()) {
            const RenderResult expected = sound(scene, small(method, 8));
            const RenderResult found = sound(far, small(method, 8));
            const double error = difference_of_means(found, expected);
            EXPECT_LT(error, bounds_of_means[i]) << method;
            worst.take(error, method);
            const double pixels = difference(found, expected);
            EXPECT_LT(pixels, bounds_of_pixels[i]) << method;
            worst_pixels.take(pixels, method);
        }
        record_extreme(fmt::format("scene moved {:.0e} of its sizes from the origin", sizes[i]),
                       fmt::format("mean within {:.0f} %, relMSE below {}",
                                   100 * bounds_of_means[i], shown(bounds_of_pixels[i])),
                       fmt::format("{}; relMSE {}", worst.text(), worst_pixels.text()));
    }
}

TEST_F(Extremes, FluxOfThirtyOrdersOfMagnitude) {
    Largest worst;
    for (const char* name : scene_names) {
        const Scene scene = load_asset(name);
        for (const std::string& method : exact_methods()) {
            const RenderResult expected = sound(scene, small(method));
            for (const float factor : {1e-30f, 1e30f}) {
                const RenderResult found = sound(brighter(scene, factor), small(method));
                const double error = difference(darker(found, factor), expected);
                EXPECT_LT(error, 1e-6) << name << ", " << method << ", factor " << factor;
                worst.take(error, fmt::format("{} {} × {:.0e}", method, name, factor));
                if (has_map(method)) {
                    const double ratio = static_cast<double>(found.statistics.flux.emitted[1]) /
                                         static_cast<double>(expected.statistics.flux.emitted[1]);
                    EXPECT_NEAR(ratio, 1, 1e-5) << "units of the mean photon";
                }
            }
        }
    }
    record_extreme("flux × 10^±30", "same picture × 10^±30; relMSE below 10^-6", worst.text());
}

TEST_F(Extremes, OneLightABillionTimesAsBrightAsAnother) {
    // Two floors that cannot see each other, each under its own light.
    Scene scene;
    scene.name = "two floors";
    const std::uint32_t material = add_material(scene, lambertian(glm::vec3(0.5f)));
    add_floor(scene, 1, 0, material);
    add_floor(scene, 1, 10, material);
    scene.lights = {point_light({0, 1, 0}, glm::vec3(1e9f)), point_light({0, 11, 0}, glm::vec3(1))};
    Largest bright;
    for (const std::string& method : exact_methods()) {
        const auto at = [&](float height) {
            RenderSettings settings = small(method, 64, 8);
            settings.bounces = 0;
            return radiance(scene, settings, {0.3f, height + 4, 0.1f}, {0, height, 0}).g;
        };
        const double below = at(0);
        bright.take(std::abs(below / (0.5e9 / double(pi)) - 1), method);
        EXPECT_RELATIVE(below, 0.5e9 / double(pi), 0.01) << method;
        EXPECT_TRUE(std::isfinite(at(10)) && at(10) >= 0);
    }
    record_extreme(
        "a light of 10^9 and one of 1",
        "surfaces that the bright one lights are exact within 1 %; those that only the dim one "
        "lights are finite (it is chosen once in 10^9 times: below the noise of the rest)",
        bright.text());
}

TEST_F(Extremes, TenThousandLights) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)));
    double expected = 0;
    for (int i = 0; i < 10'000; ++i) {
        const glm::vec3 place(0.1f * static_cast<float>(i % 100) - 5, 2,
                              0.1f * static_cast<float>(i / 100) - 5);
        scene.lights.push_back(point_light(place, glm::vec3(1e-3f)));
        const double d2 = glm::dot(glm::dvec3(place), glm::dvec3(place));
        expected += 0.5 / double(pi) * 1e-3 * 2 / (d2 * std::sqrt(d2));
    }
    Largest worst;
    for (const std::string& method : exact_methods()) {
        RenderSettings settings = small(method, 256, 8);
        settings.bounces = 0;
        const double found = radiance(scene, settings, {0.3f, 1.5f, 0.1f}, {0, 0, 0}).g;
        EXPECT_RELATIVE(found, expected, 0.03) << method;
        worst.take(std::abs(found / expected - 1), method);
    }
    record_extreme("10,000 lights",
                   "direct light within 3 % of the sum over the lights (16,384 samples)",
                   worst.text());
}

} // namespace
} // namespace argand::testing
