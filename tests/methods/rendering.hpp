#pragma once

#include "device_fixture.hpp"
#include "image/files.hpp"
#include "image/metrics.hpp"
#include "scene/gltf.hpp"
#include "scenes.hpp"
#include "session/render.hpp"
#include "support/abilities.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace argand::testing {

/// A scene of assets/, those without light under a uniform white sky.
inline Scene load_asset(const std::string& name) {
    Scene scene = load_gltf(std::string(ARGAND_SOURCE_DIR "/assets/") + name);
    if (scene.environment) {
        scene.sky = glm::vec3(1);
    }
    return scene;
}

inline const Image& layer(const RenderResult& result, const std::string& name) {
    return *find_layer(result.layers, name);
}

/// Mean over the rectangle x0 <= x < x1, y0 <= y < y1.
inline glm::dvec3 mean(const Image& image, int x0, int y0, int x1, int y1) {
    glm::dvec3 sum(0);
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            sum += glm::dvec3(image.pixels[static_cast<std::size_t>(y * image.width + x)]);
        }
    }
    return sum / static_cast<double>((x1 - x0) * (y1 - y0));
}

inline glm::dvec3 mean(const Image& image) { return mean(image, 0, 0, image.width, image.height); }

inline RenderSettings settings_of(const std::string& method, int size, std::uint32_t samples) {
    RenderSettings settings;
    settings.method = method;
    settings.width = size;
    settings.height = size;
    settings.samples = samples;
    if (method == "image-space") {
        // Most tests are about something else, and more or larger maps are slow.
        settings.own = {{"map-size", "32"}, {"maps-count", "4"}};
    }
    return settings;
}

inline RenderResult render(Device& device, const Scene& scene, const RenderSettings& settings) {
    return argand::render(device, scene, settings, [](double) { return true; });
}

inline bool same_bits(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.pixels == b.pixels;
}

inline bool same_bits(const std::vector<Layer>& a, const std::vector<Layer>& b) {
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i) {
        same = same_bits(a[i].image, b[i].image);
    }
    return same;
}

inline bool same_bits(const RenderResult& a, const RenderResult& b) {
    return same_bits(a.layers, b.layers);
}

#define EXPECT_RELATIVE(actual, expected, tolerance)                                               \
    EXPECT_NEAR(actual, expected, (tolerance)*std::abs(expected))

/// Expects the same mean radiance of each layer and channel, within a share of it, which caustics
/// have for themselves.
inline void expect_same_layers(const RenderResult& found, const RenderResult& expected,
                               double tolerance, double caustic_tolerance) {
    for (const char* name : {"direct", "indirect", "caustic"}) {
        const bool is_caustic = std::string(name) == "caustic";
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_RELATIVE(mean(layer(found, name))[channel], mean(layer(expected, name))[channel],
                            is_caustic ? caustic_tolerance : tolerance)
                << name << ", " << channel;
        }
    }
}

inline void expect_same_layers(const RenderResult& found, const RenderResult& expected,
                               double tolerance) {
    expect_same_layers(found, expected, tolerance, tolerance);
}

class RenderTest : public DeviceTest {
protected:
    Device& device() { return open(); }

    RenderResult render(const Scene& scene, const RenderSettings& settings) {
        RenderResult result = testing::render(device(), scene, settings);
        EXPECT_EQ(result.statistics.non_finite, 0u) << scene.name << ", " << settings.method;
        return result;
    }

    /// The same, but rendered once in the process for each name, which stands for scene and
    /// settings. For references.
    const RenderResult& render_once(const std::string& name, const Scene& scene,
                                    const RenderSettings& settings) {
        static std::map<std::string, RenderResult> kept;
        const auto found = kept.find(name);
        return found != kept.end() ? found->second
                                   : kept.emplace(name, render(scene, settings)).first->second;
    }

    /// Mean radiance that reaches `from` along a narrow bundle of parallel rays from `to`.
    glm::dvec3 radiance(Scene scene, const RenderSettings& settings, glm::vec3 from, glm::vec3 to,
                        const std::string& layer_name = "") {
        scene.cameras = {parallel_rays(from, to, 1e-4f * glm::distance(from, to))};
        return mean(layer(render(scene, settings), layer_name));
    }
};

/// Tests that run with several methods.
class EveryMethod : public RenderTest, public ::testing::WithParamInterface<std::string> {};

/// The methods with an estimate of their own. `progressive` and `photon-queue` share these.
inline const std::vector<std::string> estimates = {"path", "footprints", "photons", "knn"};

inline std::vector<std::string> without(std::vector<std::string> names, const std::string& name) {
    std::erase(names, name);
    return names;
}

/// A method's name as part of the name of a test, which has no hyphens.
inline std::string test_name(std::string method) {
    std::replace(method.begin(), method.end(), '-', '_');
    return method;
}

// Quick tests run one method, slow tests all others.
#define INSTANTIATE_QUICK_AND_SLOW(suite, quick, all)                                              \
    INSTANTIATE_TEST_SUITE_P(Methods, suite, ::testing::Values(quick),                             \
                             [](const auto& method) { return test_name(method.param); });          \
    INSTANTIATE_TEST_SUITE_P(SlowMethods, suite, ::testing::ValuesIn(without(all, quick)),         \
                             [](const auto& method) { return test_name(method.param); })

#define INSTANTIATE_METHODS(suite) INSTANTIATE_QUICK_AND_SLOW(suite, "footprints", method_names())

// For surfaces and lights: methods that share an estimate render them by the same kernels.
#define INSTANTIATE_ESTIMATES(suite) INSTANTIATE_QUICK_AND_SLOW(suite, "path", estimates)

} // namespace argand::testing
