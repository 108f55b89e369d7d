// Repeated reflection between GGX microfacets against quadratures of single reflection in double
// precision.
#include "materials.hpp"
#include "microfacets.hpp"
#include "shared/random.h"
#include "statistics.hpp"

#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace argand::testing;

constexpr float roughnesses[] = {0,    0.02f, 0.0317f, 0.04f, 0.07f, 0.1f, 0.15f, 0.2f,
                                 0.3f, 0.4f,  0.5f,    0.6f,  0.7f,  0.8f, 0.9f,  1};
constexpr double angles[] = {0, 20, 45, 60, 75, 82, 86, 88, 89, 89.5, 89.9, 89.99};

double once(double) { return 1; }
double grazing_weight(double cosine) { return std::pow(1 - cosine, 5); }

TEST(GgxEnergy, FitsAgreeWithQuadratures) {
    for (const float roughness : roughnesses) {
        const double alpha = double(roughness) * double(roughness);
        if (alpha < double(SMALLEST_ALPHA)) {
            continue;
        }
        for (const double angle : angles) {
            SCOPED_TRACE(::testing::Message() << "roughness " << roughness << ", " << angle);
            const float cosine = at_angle(angle).z;
            const float lost = ggx_lost(float(alpha), cosine);
            EXPECT_NEAR(lost, 1 - appendix_b::albedo(alpha, double(cosine), once), 0.004);
            EXPECT_NEAR(ggx_grazing(float(alpha), cosine, lost),
                        appendix_b::albedo(alpha, double(cosine), grazing_weight), 0.007);
        }
    }
}

// With alpha = 1 the distribution is constant, and single reflection along the normal returns the
// integral of cos / (1 + cos).
TEST(GgxEnergy, RoughestSurfaceLosesTheLogarithmOfTwo) {
    EXPECT_NEAR(ggx_lost(1.0f, 1.0f), std::log(2.0), 0.003);
}

TEST(GgxEnergy, AveragesAreThoseOfTheFits) {
    for (float alpha = 1e-3f; alpha <= 1; alpha *= 1.2f) {
        double lost = 0, grazing = 0, most = 0;
        const int steps = 20'000;
        for (int i = 0; i < steps; ++i) {
            const double root = (i + 0.5) / steps; // of the cosine
            const auto cosine = float(root * root);
            const float here = ggx_lost(alpha, cosine);
            ASSERT_GE(here, 0.0f);
            ASSERT_LT(here, 0.71f);
            const double weight = 4 * root * root * root / steps;
            lost += weight * double(here);
            grazing += weight * double(ggx_grazing(alpha, cosine, here));
            most = std::max(most, double(here));
        }
        // What the error takes from the light, at the angle that loses most.
        EXPECT_NEAR(lost / double(ggx_lost_average(alpha)), 1, 0.002 / most) << "alpha " << alpha;
        EXPECT_NEAR(ggx_grazing_average(alpha), grazing, 0.0006) << "alpha " << alpha;
    }
}

TEST(GgxEnergy, RepeatedReflectionIsSampledByItsDensity) {
    for (const float alpha : {1e-3f, 0.01f, 0.1f, 0.5f, 1.0f}) {
        constexpr int rows = 64;
        std::vector<double> counts(rows * 8), expected(rows * 8);
        constexpr int samples = 200'000;
        // Rows of equal width in the logarithm of cos² + 9 alpha².
        const double w = 9 * double(alpha) * double(alpha);
        const auto row_of = [&](double cosine) {
            return std::log1p(cosine * cosine / w) / std::log1p(1 / w) * rows;
        };
        for (int i = 0; i < samples; ++i) {
            const vec4 u = random4(31, uint(i), 0, 0);
            const vec3 wi = ggx_sample_repeated(alpha, vec2(u.x, u.y));
            ASSERT_NEAR(glm::length(glm::dvec3(wi)), 1, 1e-6);
            const double turn = std::atan2(double(wi.y), double(wi.x)) / (2 * appendix_b::pi) + 0.5;
            const int row = std::clamp(int(row_of(double(wi.z))), 0, rows - 1);
            ++counts[std::size_t(row * 8 + std::clamp(int(turn * 8), 0, 7))];
        }
        const int steps = 200'000;
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const double share = (i + 0.5) / steps;
            const double cosine = std::sqrt(w * std::expm1(share * std::log1p(1 / w)));
            const double d_cosine = (cosine * cosine + w) * std::log1p(1 / w) / (2 * cosine);
            const double p = double(ggx_repeated_pdf(alpha, float(cosine))) * d_cosine * 2 *
                             appendix_b::pi / steps;
            sum += p;
            for (int k = 0; k < 8; ++k) {
                expected[std::size_t(std::min(int(share * rows), rows - 1) * 8 + k)] +=
                    p * samples / 8;
            }
        }
        EXPECT_NEAR(sum, 1, 1e-4) << "alpha " << alpha;
        EXPECT_LT(chi_square_deviations(counts, expected), unlikely) << "alpha " << alpha;
    }
}

/// Mean weight of stratified samples, the share of light from wo that is reflected; and the
/// largest.
double reflected(const MaterialRecord& m, vec3 wo, float& largest) {
    constexpr int choices = 16, steps = 32;
    double sum = 0;
    for (int i = 0; i < choices * steps * steps; ++i) {
        const vec4 r = random4(32, uint(i), 0, 0);
        const int cell = i / choices;
        const vec4 u((float(i % choices) + r.x) / choices, (float(cell % steps) + r.y) / steps,
                     (float(cell / steps) + r.z) / steps, 0);
        BsdfSample s;
        if (bsdf_sample(m, wo, true, LOBES_ALL, min(u, vec4(0.99999994f)), s)) {
            sum += double(s.weight.x);
            largest = std::max(largest, s.weight.x);
        }
    }
    return sum / (choices * steps * steps);
}
double reflected(const MaterialRecord& m, vec3 wo) {
    float largest = 0;
    return reflected(m, wo, largest);
}

TEST(Furnace, WhiteMetalReturnsAllLight) {
    for (const float roughness : roughnesses) {
        for (const double angle : angles) {
            float largest = 0;
            const double sum = reflected(metal(vec3(1), roughness), at_angle(angle, 77), largest);
            EXPECT_NEAR(sum, 1, 0.01) << "roughness " << roughness << ", " << angle;
            // No fireflies: at most the inverse of the least share of single reflection.
            EXPECT_LT(largest, 3.3f) << "roughness " << roughness << ", " << angle;
        }
    }
}

TEST(Furnace, WhiteDielectricReturnsAllLight) {
    for (const float roughness : roughnesses) {
        for (const double angle : angles) {
            MaterialRecord m = white_dielectric();
            m.roughness = roughness;
            const double sum = reflected(m, at_angle(angle, 77));
            EXPECT_NEAR(sum, 1, 0.015) << "roughness " << roughness << ", " << angle;
        }
    }
}

// Lobes are chosen, and paths ended, by this albedo.
TEST(Furnace, AlbedoIsWhatIsReflected) {
    std::mt19937 bits(33);
    for (int i = 0; i < 200; ++i) {
        MaterialRecord m = any_material(bits);
        m.transmission = 0;
        m.coverage = 1;
        const vec3 wo = any_upper(bits);
        EXPECT_NEAR(bsdf_albedo(m, wo, true, LOBES_ALL).x, reflected(m, wo), 0.015) << "case " << i;
    }
}

// Light that microfacets of constant reflectance F reflect k times leaves with F^k. Its series,
// summed term by term.
TEST(GgxEnergy, ColorFollowsFromTheNumberOfReflections) {
    for (const float reflectance : {0.0f, 0.2f, 0.7f, 1.0f}) {
        for (const float lost : {0.0f, 0.1f, 0.59f}) {
            const vec3 color = ggx_repeated_color(vec3(reflectance), reflectance, lost);
            double sum = 0, power = 1;
            for (int k = 1; k < 200; ++k) {
                power *= double(reflectance);
                sum += k >= 2 ? power * std::pow(double(lost), k - 2) * (1 - double(lost)) : 0;
            }
            EXPECT_NEAR(color.x, sum, 1e-6) << reflectance << ", " << lost;
        }
    }
}

} // namespace
} // namespace argand
