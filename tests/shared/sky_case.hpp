// The sampling of a sky's picture against its density, and its radiance against formulas in double
// precision. The text is compiled in single and in double precision (ARGAND_REAL_DOUBLE).
#pragma once

#include "shared/lights.h"
#include "shared/random.h"
#include "shared/sky.h"
#include "statistics.hpp"
#include "world/sky_table.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#ifdef ARGAND_REAL_DOUBLE
#define SKY_TEST(name) TEST(SkyDouble, name)
namespace argand::oracle {
constexpr double least = 2e-5; // of a texel's width: the table tells borders of rows as floats
#else
#define SKY_TEST(name) TEST(Sky, name)
namespace argand {
constexpr double least = 2e-4; // and 24 bits tell places in a row of thousands
#endif
namespace {

using argand::testing::chi_square_deviations;
using argand::testing::unlikely;

constexpr double pi_d = std::numbers::pi;

/// The kernels' text.
struct SkyKernel {
    const uint* sky;
#include "shared/kernels/sky.h"
};

struct Sky {
    argand::SkyTable table;
    SkyKernel kernel{};

    explicit Sky(argand::SkyTable of) : table(std::move(of)) { kernel.sky = table.words.data(); }
    Sky(const Sky&) = delete;
    Sky& operator=(const Sky&) = delete;
};

using Texels = std::vector<glm::vec3>;

argand::SkyTable table_of(int width, int height, const Texels& texels, double rotation = 0,
                          const std::optional<argand::Sun>& sun = {}) {
    argand::Environment environment;
    environment.picture = argand::make_sky_picture(width, height, texels, "test");
    environment.rotation = rotation;
    environment.sun = sun;
    return argand::make_sky_table(environment, 1u << 28);
}

Texels noise(int width, int height, double low, double high) {
    std::mt19937 bits(5);
    std::uniform_real_distribution<double> exponent(std::log(low), std::log(high));
    Texels texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (glm::vec3& texel : texels) {
        texel =
            glm::vec3(std::exp(exponent(bits)), std::exp(exponent(bits)), std::exp(exponent(bits)));
    }
    return texels;
}

/// Dim, but for one texel.
Texels one_bright(int width, int height, int column, int row, float dim, float bright) {
    Texels texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                  glm::vec3(dim));
    texels[static_cast<std::size_t>(row * width + column)] = glm::vec3(bright);
    return texels;
}

argand::Sun a_sun() {
    argand::Sun sun;
    sun.towards = glm::normalize(glm::vec3(0.3f, 0.5f, -0.7f));
    sun.radius = 0.05f;
    sun.radiance = glm::vec3(1000, 900, 800);
    return sun;
}

struct Case {
    std::string name;
    argand::SkyTable table;
};

std::vector<Case> cases() {
    std::vector<Case> all;
    const auto add = [&](const char* name, argand::SkyTable table) {
        all.push_back({name, std::move(table)});
    };
    add("one texel", table_of(1, 1, {glm::vec3(2)}));
    add("a row", table_of(7, 1, noise(7, 1, 0.1, 10)));
    add("a column", table_of(1, 9, noise(1, 9, 0.1, 10)));
    add("odd", table_of(5, 3, noise(5, 3, 0.01, 100), 77));
    add("even", table_of(64, 32, noise(64, 32, 1e-4, 10), -200));
    add("large", table_of(1000, 501, noise(1000, 501, 1e-6, 1)));
    add("a bright texel", table_of(2048, 1024, one_bright(2048, 1024, 3, 300, 1e-3f, 1e5f)));
    add("one alone", table_of(33, 17, one_bright(33, 17, 32, 0, 0, 1e20f), 10));
    add("alone at the pole", table_of(512, 256, one_bright(512, 256, 9, 255, 0, 1e-20f)));
    add("with a sun", table_of(32, 16, noise(32, 16, 0.1, 10), 30, a_sun()));
    add("a sun in a black sky", table_of(1, 1, {glm::vec3(0)}, 30, a_sun()));
    return all;
}

/// Where a direction lies in the picture, by the standard library.
glm::dvec2 place_in_picture(const glm::dvec3& d, double degrees) {
    const double angle = degrees * pi_d / 180;
    const double x = d.x * std::cos(angle) - d.z * std::sin(angle);
    const double z = d.x * std::sin(angle) + d.z * std::cos(angle);
    return {0.5 + std::atan2(z, x) / (2 * pi_d), std::atan2(std::hypot(x, z), d.y) / pi_d};
}

/// Radiance of a picture, by the standard library.
glm::dvec3 expected_radiance(const Texels& texels, int width, int height, const glm::dvec3& d,
                             double degrees) {
    const glm::dvec2 place = place_in_picture(d, degrees);
    const double across = place.x * width - 0.5 + width;
    const int column = static_cast<int>(across);
    const double x = across - column;
    const int row = static_cast<int>(std::floor(place.y * height - 0.5));
    const auto cosine = [&](int of) { return std::cos(pi_d * (of + 0.5) / height); };
    const double y = row < 0             ? 1
                     : row == height - 1 ? 0
                                         : (cosine(row) - std::cos(pi_d * place.y)) /
                                               (cosine(row) - cosine(row + 1));
    const auto texel = [&](int r, int c) {
        return glm::dvec3(
            texels[static_cast<std::size_t>(std::clamp(r, 0, height - 1) * width + c % width)]);
    };
    return glm::mix(glm::mix(texel(row, column), texel(row, column + 1), x),
                    glm::mix(texel(row + 1, column), texel(row + 1, column + 1), x), y);
}

/// A unit vector, as finely as `real` has it.
vec3 any_direction(uint i) {
    const vec4 u = random4(3, i, 0, 0);
    return sample_sphere(vec2(u.x, u.y));
}

SKY_TEST(RadianceIsBilinearWithTheOrientationOfThreeJs) {
    struct Size {
        int width, height;
        double rotation;
    };
    for (const Size& size : {Size{1, 1, 0}, Size{1, 9, 20}, Size{8, 1, -35}, Size{5, 3, 0},
                             Size{64, 32, 123}, Size{1, 4096, 0}, Size{2048, 1024, 361}}) {
        const Texels texels = noise(size.width, size.height, 1, 2);
        Sky sky(table_of(size.width, size.height, texels, size.rotation));
        for (uint i = 0; i < 3000; ++i) {
            vec3 d = any_direction(i);
            if (i % 10 == 0) { // near the seam and the poles
                d = glm::normalize(i % 20 == 0 ? vec3(-1, d.y, d.z * real(1e-3))
                                               : vec3(d.x * real(1e-3), d.y < 0 ? -1 : 1, d.z));
            }
            const vec3 found = sky.kernel.sky_at(d, false).radiance;
            const glm::dvec3 expected =
                expected_radiance(texels, size.width, size.height, glm::dvec3(d), size.rotation);
            const double tolerance = 2e-5 + least * 1e-3 * std::max(size.width, 2 * size.height);
            for (int c = 0; c < 3; ++c) {
                ASSERT_NEAR(found[c], expected[c], tolerance * expected[c])
                    << size.width << " x " << size.height << ", " << i << ": " << d.x << " " << d.y
                    << " " << d.z;
            }
        }
    }
    // A picture whose middle column is red, and that to the right of it green: +X and +Z.
    Texels texels(8 * 4, glm::vec3(0));
    for (std::size_t row = 0; row < 4; ++row) {
        texels[8 * row + 3] = texels[8 * row + 4] = {1, 0, 0};
        texels[8 * row + 5] = texels[8 * row + 6] = {0, 1, 0};
    }
    Sky sky(table_of(8, 4, texels));
    EXPECT_NEAR(sky.kernel.sky_at(vec3(1, 0, 0), false).radiance.x, 1, 1e-5);
    EXPECT_NEAR(sky.kernel.sky_at(vec3(0, 0, 1), false).radiance.y, 1, 1e-5);
    // Turned by 90 degrees about +Y, +X goes to -Z.
    Sky turned(table_of(8, 4, texels, 90));
    EXPECT_NEAR(turned.kernel.sky_at(vec3(0, 0, -1), false).radiance.x, 1, 1e-5);
}

// Digits per row and cell are the probabilities of samples: counts by chi-square.
SKY_TEST(SamplesFollowTheDensity) {
    for (const Case& c : cases()) {
        Sky sky(c.table);
        SkyKernel& k = sky.kernel;
        const double of_sun = k.sky_float(sun_probability);
        const uint rows = k.sky[sky_height] + 1, columns = k.sky[sky_width];
        std::vector<double> expected(std::size_t(rows) * columns);
        for (uint row = 0; row < rows; ++row) {
            const double of_row =
                double(k.sky[k.row_of_sky(row + 1)] - k.sky[k.row_of_sky(row)]) / sky_digits;
            for (uint column = 0; column < columns; ++column) {
                expected[row * columns + column] =
                    of_row * k.digits_of_cell(row, column) / sky_digits;
            }
        }
        constexpr uint samples = 100'000;
        std::vector<double> counts(expected.size(), 0.0), of_rows(rows, 0.0),
            expected_rows(rows, 0.0);
        double all = 0;
        for (uint i = 0; i < samples && of_sun < 1; ++i) {
            const vec4 u = random4(11, i, 0, 0);
            const SkyCell cell = k.sample_cell_of_sky(vec2(u.x, u.y));
            ASSERT_LT(cell.row, rows);
            ASSERT_LT(cell.column, columns);
            counts[cell.row * columns + cell.column] += 1;
            of_rows[cell.row] += 1;
            ++all;
        }
        for (std::size_t i = 0; i < expected.size(); ++i) {
            expected[i] *= all;
            expected_rows[i / columns] += expected[i];
        }
        // Chi-square takes two cells that expect 5 samples.
        const auto expect_right = [&](const std::vector<double>& n, const std::vector<double>& e) {
            const auto few = std::count_if(e.begin(), e.end(), [](double x) { return x < 5; });
            if (static_cast<std::size_t>(few) + 2 <= e.size()) {
                EXPECT_LT(chi_square_deviations(n, e), unlikely) << c.name;
            }
            for (std::size_t i = 0; i < n.size(); ++i) {
                ASSERT_TRUE(e[i] > 0 || n[i] == 0) << c.name << ", " << i;
            }
        };
        expect_right(counts, expected);
        expect_right(of_rows, expected_rows);
    }
}

// The mean of a function over the density is its integral: of 1 where the sky is not black, of the
// radiance, and of the parts of the sphere. So the density that paths ask for is that of samples.
SKY_TEST(SamplesIntegrateFunctions) {
    for (const Case& c : cases()) {
        Sky sky(c.table);
        const bool alone = c.name == "one alone" || c.name == "alone at the pole" ||
                           c.name == "a sun in a black sky";
        testing::Mean one, east, up;
        constexpr uint samples = 200'000;
        for (uint i = 0; i < samples; ++i) {
            const vec4 u = random4(12, i, 0, 0);
            const vec3 d = sky.kernel.sample_sky(vec2(u.x, u.y));
            ASSERT_NEAR(glm::length(d), 1, 1e-5) << c.name << ", " << i;
            const SkyPoint p = sky.kernel.sky_at(d, true);
            ASSERT_GE(p.pdf, 0) << c.name << ", " << i;
            const double weight = p.pdf > 0 ? 1 / double(p.pdf) : 0;
            one.add(weight);
            east.add(d.x > 0 ? weight : 0);
            up.add(weight * double(d.y) * double(d.y));
        }
        if (!alone) {
            EXPECT_NEAR(one.value(), 4 * pi_d, unlikely * one.deviation() + 1e-3) << c.name;
            EXPECT_NEAR(east.value(), 2 * pi_d, unlikely * east.deviation() + 1e-3) << c.name;
            EXPECT_NEAR(up.value(), 4 * pi_d / 3, unlikely * up.deviation() + 1e-3) << c.name;
        }
    }
}

// Directions come in proportion to brightness: what a sample brings hardly varies.
SKY_TEST(SamplesBringTheMeanRadiance) {
    for (const Case& c : cases()) {
        Sky sky(c.table);
        // By quadrature over the cells: their solid angle times the mean of their corners.
        SkyKernel& k = sky.kernel;
        double mean = 0;
        for (uint row = 0; row <= k.sky[sky_height]; ++row) {
            const double share = double(k.border_of_sky(row + 1).x) - k.border_of_sky(row).x;
            for (uint column = 0; column < k.sky[sky_width]; ++column) {
                mean += share / k.sky[sky_width] *
                        brightness_of_cell(k.corners_of_cell({row, column, 0, 0}));
            }
        }
        const Cone sun = k.cone_of_sun();
        if (sun.height > 0) {
            mean += sky_brightness(k.sky_float3(sun_radiance)) * cone_solid_angle(sun) / (4 * pi_d);
        }
        testing::Mean found;
        for (uint i = 0; i < 100'000; ++i) {
            const vec4 u = random4(13, i, 0, 0);
            const SkyPoint p = k.sky_at(k.sample_sky(vec2(u.x, u.y)), true);
            const double brought =
                p.pdf > 0 ? sky_brightness(p.radiance) / double(p.pdf) / (4 * pi_d) : 0;
            EXPECT_LT(brought, 2.5 * mean) << c.name;
            found.add(brought);
        }
        EXPECT_NEAR(found.value(), mean, unlikely * found.deviation() + 2e-3 * mean) << c.name;
        const double deviation = found.deviation() * std::sqrt(found.count);
        EXPECT_LT(deviation, (k.sky_float(sun_probability) > 0 ? 0.8 : 0.5) * mean) << c.name;
    }
}

SKY_TEST(LinearDensitiesAreSampledAndInverted) {
    for (const vec2& ends : {vec2(1, 1), vec2(0, 1), vec2(1, 0), vec2(1e-20, 1e20), vec2(1e30, 1),
                             vec2(0, 0), vec2(3, 2), vec2(1e-30, 1e-32)}) {
        for (int i = 0; i < 100; ++i) {
            const real u = real(i) / real(100);
            const real x = sample_linear(ends.x, ends.y, u);
            ASSERT_GE(x, 0);
            ASSERT_LT(x, 1);
            ASSERT_NEAR(number_of_linear(ends.x, ends.y, x), u, 1e-6)
                << ends.x << " " << ends.y << " " << u;
        }
    }
}

} // namespace
}
