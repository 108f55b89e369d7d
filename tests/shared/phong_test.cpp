// The modified Phong BRDF (Lafortune and Willems 1994), as functions and as a material.
#include "materials.hpp"
#include "shared/random.h"
#include "statistics.hpp"

#include <gtest/gtest.h>
#include <numeric>

namespace argand {
namespace {

using namespace argand::testing;

constexpr double pi = 3.14159265358979323846;
constexpr float exponents[] = {0, 0.5f, 1, 8, 100, 1e4f, 1e6f};

/// Maps the unit square to directions around the mirror direction of wo, in double precision. u.y
/// is the share of (n + 1)/(2π) cosⁿ that is closer to the mirror direction.
glm::dvec3 around_mirror(glm::dvec3 wo, double n, glm::dvec2 u) {
    const glm::dvec3 axis(-wo.x, -wo.y, wo.z);
    const glm::dvec3 x = glm::normalize(
        glm::cross(std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), axis));
    const glm::dvec3 y = glm::cross(axis, x);
    const double complement = -std::expm1(std::log1p(-u.y) / (n + 1));
    const double sine = std::sqrt(complement * (2 - complement));
    return axis * (1 - complement) +
           sine * (std::cos(2 * pi * u.x) * x + std::sin(2 * pi * u.x) * y);
}

/// Means over the cells of that square, by the midpoint rule, of a function of wi over the density
/// cosⁿ (n + 1)/(2π).
template <class F>
std::vector<double> over_lobe(glm::dvec3 wo, double n, int cells, int steps, const F& f) {
    std::vector<double> means(std::size_t(cells) * std::size_t(cells));
    for (int i = 0; i < cells * steps * cells * steps; ++i) {
        const int row = i / (cells * steps);
        const int column = i % (cells * steps);
        const glm::dvec2 u((column + 0.5) / (cells * steps), (row + 0.5) / (cells * steps));
        const glm::dvec3 wi = around_mirror(wo, n, u);
        const double density = (n + 1) / (2 * pi) * std::pow(1 - u.y, n / (n + 1));
        if (wi.z > 0) {
            means[std::size_t(row / steps * cells + column / steps)] +=
                f(wi) / density / (steps * steps);
        }
    }
    return means;
}

/// Share of light from wo that the material reflects without delta lobes (red channel).
double reflected(const MaterialRecord& m, glm::dvec3 wo) {
    const auto glossy = over_lobe(wo, m.exponent, 1, 400, [&](glm::dvec3 wi) {
        return truth::bsdf_eval(record_bytes(m), wo, wi, LOBE_GLOSSY).x * wi.z;
    });
    return glossy[0] + double(m.base_r) * double(m.coverage);
}

TEST(Phong, HasItsLobes) {
    EXPECT_EQ(bsdf_lobes(phong(vec3(0.5f), vec3(0.5f), 20)), LOBE_DIFFUSE | LOBE_GLOSSY);
    EXPECT_EQ(bsdf_lobes(phong(vec3(0), vec3(0.5f), 20)), LOBE_GLOSSY);
    EXPECT_EQ(bsdf_lobes(phong(vec3(0.5f), vec3(0), 20)), LOBE_DIFFUSE);
    EXPECT_EQ(bsdf_lobes(with_alpha(phong(vec3(0.5f), vec3(0), 20), 0.5f)), LOBE_DIFFUSE);
    EXPECT_EQ(bsdf_lobes(phong(vec3(0.5f), vec3(0.5f), 1e6f)), LOBE_DIFFUSE | LOBE_GLOSSY);
    EXPECT_EQ(bsdf_lobes(phong(vec3(0.5f), vec3(0.5f), 1e7f)), LOBE_DIFFUSE | LOBE_MIRROR);
    EXPECT_EQ(roughness_of_phong(0), 1.0f);
    EXPECT_NEAR(std::pow(double(roughness_of_phong(1e4f)), 4), 2 / 10002.0, 1e-9);
}

TEST(Phong, AgreesWithTheFormula) {
    std::mt19937 bits(1);
    for (int i = 0; i < 100'000; ++i) {
        const float n = exponents[bits() % std::size(exponents)];
        const vec3 wo = any_upper(bits);
        const glm::dvec3 toward =
            around_mirror(glm::dvec3(wo), n, {to_unit_float(bits), to_unit_float(bits)});
        if (toward.z <= 0) {
            continue;
        }
        const vec3 wi = rounded(toward);
        const glm::dvec3 axis = glm::normalize(glm::dvec3(-wo.x, -wo.y, wo.z));
        const double sine = glm::length(glm::cross(axis, glm::normalize(glm::dvec3(wi))));
        const double cosine = glm::dot(axis, glm::normalize(glm::dvec3(wi)));
        // From the sine, which keeps its digits in narrow lobes.
        const double power = cosine < 0.5 ? std::pow(std::max(cosine, 0.0), double(n))
                                          : std::exp(0.5 * double(n) * std::log1p(-sine * sine));
        const MaterialRecord m = phong(vec3(0.25f), vec3(0.5f, 0.25f, 0), n);
        const vec3 f = bsdf_eval(m, wo, wi, LOBES_ALL);
        const double peak = (double(n) + 2) / (2 * pi);
        // Directions in single precision are accurate to 1e-7 in length and place.
        const double bound =
            2e-6 *
            (0.25 + peak * (0.5 * std::sqrt(double(n)) * std::sqrt(std::sqrt(power)) + power));
        ASSERT_NEAR(f.x, 0.25 / pi + 0.5 * peak * power, bound) << "n " << n << ", power " << power;
        ASSERT_NEAR(f.y, 0.25 / pi + 0.25 * peak * power, bound)
            << "n " << n << ", power " << power;
        ASSERT_FLOAT_EQ(f.z, float(0.25 / pi));
    }
}

TEST(Phong, IsReciprocal) {
    std::mt19937 bits(2);
    for (int i = 0; i < 100'000; ++i) {
        const MaterialRecord m = any_phong(bits);
        const vec3 a = any_upper(bits);
        const vec3 b = rounded(
            around_mirror(glm::dvec3(a), m.exponent, {to_unit_float(bits), to_unit_float(bits)}));
        ASSERT_EQ(bsdf_eval(m, a, b, LOBES_ALL), bsdf_eval(m, b, a, LOBES_ALL)) << "case " << i;
    }
}

TEST(Phong, ReflectsAllLightAlongTheNormalAndLessElsewhere) {
    for (const float n : exponents) {
        const MaterialRecord m = phong(vec3(0.375f), vec3(0.625f), n);
        EXPECT_NEAR(reflected(m, {0, 0, 1}), 1, 2e-4) << "n " << n;
        for (const double angle : {20.0, 50.0, 70.0, 85.0, 89.9}) {
            const glm::dvec3 wo(at_angle(angle, 40));
            const double sum = reflected(m, wo);
            EXPECT_LT(sum, 1.0001) << "n " << n << ", angle " << angle;
            EXPECT_GT(sum, 0.375) << "n " << n << ", angle " << angle;
            // Russian roulette and the choice of lobes use this approximation.
            EXPECT_NEAR(bsdf_albedo(m, vec3(wo), true, LOBES_ALL).x, sum, 0.1)
                << "n " << n << ", angle " << angle;
        }
        if (n >= 100) { // nearly a mirror of k_s cos
            EXPECT_NEAR(reflected(m, glm::dvec3(at_angle(60))), 0.375 + 0.625 * 0.5, 0.01)
                << "n " << n;
        }
    }
}

TEST(Phong, SamplingFollowsTheDensity) {
    constexpr int cells = 16;
    for (const float n : exponents) {
        for (const double angle : {0.0, 45.0, 85.0}) {
            const vec3 wo = at_angle(angle, 77);
            for (const float diffuse : {0.0f, 0.4f}) {
                SCOPED_TRACE(::testing::Message()
                             << "n " << n << ", " << angle << " degrees, diffuse " << diffuse);
                const MaterialRecord m = phong(vec3(diffuse), vec3(0.6f), n);
                const double glossy = double(lobe_probabilities(m, wo, LOBES_ALL).y);
                const auto density = over_lobe(glm::dvec3(wo), n, cells, 16, [&](glm::dvec3 wi) {
                    return glossy *
                           truth::bsdf_pdf(record_bytes(m), glm::dvec3(wo), wi, LOBE_GLOSSY);
                });
                std::vector<double> counts(density.size());
                Mean weight;
                constexpr int samples = 60'000;
                for (int i = 0; i < samples; ++i) {
                    BsdfSample s;
                    const bool scattered =
                        bsdf_sample(m, wo, true, LOBES_ALL, random4(21, uint(i), 0, 0), s);
                    weight.add(scattered ? double(s.weight.x) : 0);
                    if (!scattered) {
                        continue;
                    }
                    ASSERT_GT(s.wi.z, 0.0f);
                    ASSERT_NEAR(glm::length(glm::dvec3(s.wi)), 1, 1e-6);
                    ASSERT_NEAR(s.pdf, bsdf_pdf(m, wo, s.wi, LOBES_ALL), 1e-5 * s.pdf);
                    ASSERT_LE(s.weight.x, 2.0f);
                    if (s.lobe == LOBE_GLOSSY) {
                        const glm::dvec3 axis(-wo.x, -wo.y, wo.z);
                        const glm::dvec3 d = glm::dvec3(s.wi) - axis;
                        const double nearer =
                            -std::expm1((double(n) + 1) * std::log1p(-0.5 * glm::dot(d, d)));
                        const glm::dvec3 x = glm::normalize(glm::cross(
                            std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0),
                            axis));
                        const double turn =
                            std::atan2(glm::dot(d, glm::cross(axis, x)), glm::dot(d, x)) / (2 * pi);
                        const auto row = std::min(cells - 1, int(nearer * cells));
                        const auto column =
                            std::min(cells - 1, int((turn < 0 ? turn + 1 : turn) * cells));
                        ++counts[std::size_t(row * cells + column)];
                    }
                }
                std::vector<double> expected;
                for (const double p : density) {
                    expected.push_back(p * samples / double(cells * cells));
                }
                const double inside =
                    std::accumulate(expected.begin(), expected.end(), 0.0) / samples;
                EXPECT_LE(inside, glossy * 1.0001);
                const double counted = std::accumulate(counts.begin(), counts.end(), 0.0);
                EXPECT_NEAR(counted / samples, inside,
                            5 * std::sqrt(inside * std::abs(1 - inside) / samples) + 2e-3);
                EXPECT_LT(chi_square_deviations(counts, expected), unlikely);
                EXPECT_NEAR(weight.value(), reflected(m, glm::dvec3(wo)),
                            5 * weight.deviation() + 2e-3);
            }
        }
    }
}

// A lobe too narrow for single precision: the limit of growing exponents.
TEST(Phong, BecomesAMirror) {
    const MaterialRecord m = phong(vec3(0), vec3(0.8f, 0.4f, 0), 1e7f);
    for (const double angle : {0.0, 60.0, 89.0}) {
        const vec3 wo = at_angle(angle, 20);
        BsdfSample s;
        ASSERT_TRUE(bsdf_sample(m, wo, true, LOBES_ALL, vec4(0.5f), s));
        EXPECT_EQ(s.lobe, LOBE_MIRROR);
        EXPECT_EQ(s.wi, vec3(-wo.x, -wo.y, wo.z));
        EXPECT_NEAR(s.weight.x, 0.8 * double(wo.z), 2e-4);
        EXPECT_NEAR(s.weight.y, 0.4 * double(wo.z), 2e-4);
        EXPECT_EQ(s.weight.z, 0.0f);
    }
}

TEST(Phong, IsFiniteAtTheExtremes) {
    std::mt19937 bits(3);
    for (const float n : {0.0f, 1e-38f, 1e4f, 1e6f, 1.9e6f, 3e38f}) {
        for (int i = 0; i < 20'000; ++i) {
            const MaterialRecord m = phong(vec3(0.2f), vec3(0.8f), n);
            const vec3 wo = any_upper(bits);
            const vec3 wi = i % 2 == 0 ? any_upper(bits) : vec3(-wo.x, -wo.y, wo.z);
            ASSERT_TRUE(is_finite3(bsdf_eval(m, wo, wi, LOBES_ALL)));
            const float ends[] = {0, 0x1p-24f, 1 - 0x1p-24f, to_unit_float(bits)};
            BsdfSample s;
            if (bsdf_sample(m, wo, true, LOBES_ALL,
                            vec4(0.99f, ends[bits() % 4], ends[bits() % 4], 0), s)) {
                ASSERT_TRUE(is_finite3(s.weight) && is_finite(s.pdf) && is_finite3(s.wi));
            }
        }
    }
}

} // namespace
} // namespace argand
