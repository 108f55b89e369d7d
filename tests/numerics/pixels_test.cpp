// An image whose radiance is known by a formula: compares every pixel with it in double precision.
#include "extremes.hpp"

namespace argand::testing {
namespace {

/// Radiance of a floor of albedo 1/2 under a light of intensity 2 at height 1, at distance r from
/// the point below the light.
double floor_radiance(double r) {
    const double d2 = r * r + 1;
    return 0.5 / double(pi) * 2 / (d2 * std::sqrt(d2));
}

/// Least and greatest distance from 0 of the numbers between a and b.
glm::dvec2 distances(double a, double b) {
    const double far = std::max(std::abs(a), std::abs(b));
    return {a * b <= 0 ? 0.0 : std::min(std::abs(a), std::abs(b)), far};
}

TEST_F(Extremes, EveryPixelFollowsTheFormula) {
    constexpr int size = 64;
    const Scene scene = load_asset("plane_point.gltf"); // seen from 3 above the light's foot
    const double half = 3 * std::tan(double(scene.cameras.at(0).vertical_angle) / 2);
    Largest worst;
    Largest worst_mean;
    for (const std::string& method : exact_methods()) {
        const RenderResult result = sound(scene, small(method, 16, size));
        double expected = 0;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const auto edge = [&](int i) { return half * (2.0 * i / size - 1); };
                const glm::dvec2 across = distances(edge(x), edge(x + 1));
                const glm::dvec2 down = distances(edge(y), edge(y + 1));
                // Bounds for any sample positions within the pixel.
                const double high = floor_radiance(std::hypot(across[0], down[0]));
                const double low = floor_radiance(std::hypot(across[1], down[1]));
                const double found =
                    layer(result, "").pixels[static_cast<std::size_t>(y * size + x)].g;
                const double outside = std::max({low - found, found - high, 0.0}) / high;
                EXPECT_LT(outside, 1e-6) << method << ", x " << x << ", y " << y;
                worst.take(outside, method);
                constexpr int n = 4;
                for (int i = 0; i < n * n; ++i) {
                    expected +=
                        floor_radiance(std::hypot(half * (2 * (x + (i % n + 0.5) / n) / size - 1),
                                                  half * (2 * (y + (i / n + 0.5) / n) / size - 1)));
                }
            }
        }
        expected /= 16.0 * size * size;
        const double error = std::abs(mean(layer(result, "")).g / expected - 1);
        EXPECT_LT(error, 1e-4) << method;
        worst_mean.take(error, method);
    }
    record_extreme("a floor under a point light, compared with the formula in double precision",
                   "each pixel between the least and the greatest radiance within it, to 10^-6; "
                   "mean within 10^-4",
                   fmt::format("outside by {}; mean off by {}", worst.text(), worst_mean.text()));
}

} // namespace
} // namespace argand::testing
