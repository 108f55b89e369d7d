#pragma once

#include "methods/rendering.hpp"
#include "results.hpp"

#include <fmt/format.h>

namespace argand::testing {

/// Renders images in extreme situations. Checks for each what always holds: every value is finite
/// and not negative, every photon is emitted, and all of its flux is accounted for.
class Extremes : public RenderTest {
protected:
    static RenderSettings small(const std::string& method, std::uint32_t samples = 4,
                                int size = 16) {
        RenderSettings settings = settings_of(method, size, samples);
        settings.photons = 5000;
        return settings;
    }

    RenderResult sound(const Scene& scene, const RenderSettings& settings) {
        SCOPED_TRACE(scene.name + ", " + settings.method);
        const RenderResult result = render(scene, settings);
        for (const Layer& part : result.layers) {
            for (const glm::vec3& pixel : part.image.pixels) {
                for (int channel = 0; channel < 3; ++channel) {
                    EXPECT_TRUE(pixel[channel] >= 0 && std::isfinite(pixel[channel])) << part.name;
                }
            }
        }
        if (has_map(settings.method)) {
            const FluxSums& flux = result.statistics.flux;
            EXPECT_EQ(result.statistics.photons_emitted,
                      settings.bounces > 0 ? settings.photons : 0);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                EXPECT_EQ(flux.emitted[channel], flux.absorbed[channel] + flux.escaped[channel] +
                                                     flux.cut[channel] + flux.lost[channel]);
            }
        }
        return result;
    }

    /// relMSE of the whole image.
    static double difference(const RenderResult& a, const RenderResult& b) {
        return compare(layer(a, ""), layer(b, "")).rel_mse;
    }

    /// Relative difference of the mean radiance, the largest over the channels.
    static double difference_of_means(const RenderResult& a, const RenderResult& b,
                                      const std::string& name = "") {
        const glm::dvec3 x = mean(layer(a, name));
        const glm::dvec3 y = mean(layer(b, name));
        double largest = 0;
        for (int channel = 0; channel < 3; ++channel) {
            largest = std::max(largest, std::abs(x[channel] - y[channel]) /
                                            std::max(std::abs(y[channel]), 1e-300));
        }
        return largest;
    }
};

/// The largest value of a figure, and where it occurred.
struct Largest {
    double value = 0;
    std::string where;
    void take(double v, const std::string& at) {
        if (!(v <= value)) {
            value = v;
            where = at;
        }
    }
    std::string text() const { return shown(value) + (where.empty() ? "" : " (" + where + ")"); }
};

} // namespace argand::testing
