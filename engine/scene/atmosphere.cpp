#include "scene/atmosphere.hpp"

#include "base/thread_each.hpp"
#include "scene/atmosphere_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace argand {

namespace {

using std::numbers::pi;

constexpr int picture_width = 256, picture_height = 256;
constexpr double height_of_eye = 2;           // m
constexpr double radius_of_sun = 0.004652439; // rad, seen from 1 AU
constexpr double albedo_below = 0.2;

glm::vec3 not_negative(const glm::dvec3& color) { return glm::max(glm::vec3(color), 0.0f); }

/// Share of the sun's disc above the horizon.
double share_above_horizon(double elevation) {
    const double x = std::clamp(elevation / radius_of_sun, -1.0, 1.0);
    return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / pi;
}

} // namespace

Environment sun_and_sky(const SunPosition& sun) {
    const Atmosphere air(sun.turbidity);
    const double elevation = sun.elevation * pi / 180;
    const double mu_s = std::sin(elevation), sine_s = std::cos(elevation);
    constexpr double r = Atmosphere::ground + height_of_eye;
    constexpr int upper_rows = picture_height / 2;

    // The sun is at azimuth 0, in the middle of the picture, whose halves are mirror images.
    std::vector<glm::vec3> texels(std::size_t(picture_width) * picture_height);
    const auto texel = [&](int row, int column) -> glm::vec3& {
        return texels[static_cast<std::size_t>(row) * picture_width +
                      static_cast<std::size_t>(column)];
    };
    for_each_on_all_cores(upper_rows, [&](std::size_t at) {
        const int row = static_cast<int>(at);
        const double mu = std::cos(pi * (row + 0.5) / picture_height);
        const double sine = std::sqrt(1 - mu * mu);
        for (int column = picture_width / 2; column < picture_width; ++column) {
            const double turn = 2 * pi * ((column + 0.5) / picture_width - 0.5);
            const double nu = std::clamp(sine * sine_s * std::cos(turn) + mu * mu_s, -1.0, 1.0);
            texel(row, column) = not_negative(color_of(air.radiance(r, mu, mu_s, nu)));
            texel(row, picture_width - 1 - column) = texel(row, column);
        }
    });

    Environment environment;
    environment.name = "sun and sky";
    Sun disc;
    disc.towards = {static_cast<float>(sine_s), static_cast<float>(mu_s), 0};
    Spectrum arriving = air.transmittance(r, std::max(mu_s, 0.0));
    const Spectrum outside = Atmosphere::of_sun();
    for (std::size_t i = 0; i < wavelengths; ++i) {
        arriving[i] *= outside[i] * share_above_horizon(elevation);
    }
    const glm::dvec3 of_sun = glm::max(color_of(arriving), 0.0);
    const double sine_of_radius = std::sin(radius_of_sun);
    disc.radius = static_cast<float>(radius_of_sun);
    disc.radiance = glm::vec3(of_sun / (pi * sine_of_radius * sine_of_radius));

    // The ground reflects the sun and the sky.
    glm::dvec3 irradiance = of_sun * std::max(mu_s, 0.0);
    for (int row = 0; row < upper_rows; ++row) {
        const double above = std::cos(pi * row / picture_height);
        const double below = std::cos(pi * (row + 1) / picture_height);
        for (int column = 0; column < picture_width; ++column) {
            irradiance += glm::dvec3(texel(row, column)) *
                          (pi * (above * above - below * below) / picture_width);
        }
    }
    std::fill(texels.begin() + std::ptrdiff_t(upper_rows) * picture_width, texels.end(),
              glm::vec3(irradiance * (albedo_below / pi)));

    environment.picture =
        make_sky_picture(picture_width, picture_height, std::move(texels), environment.name);
    if (glm::any(glm::greaterThan(disc.radiance, glm::vec3(0)))) {
        environment.sun = disc;
    }
    environment.rotation = 90 - sun.azimuth; // +X, at azimuth 90, goes there
    return environment;
}

} // namespace argand
