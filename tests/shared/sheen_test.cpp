// Sheen (KHR_materials_sheen) against the extension's formulas in double precision, its albedo by
// quadrature, furnace and reciprocity.
#include "materials.hpp"
#include "shared/random.h"
#include "statistics.hpp"

#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace argand::testing;

constexpr double pi = 3.14159265358979323846;

double mix(double a, double b, double t) { return a * (1 - t) + b * t; }

double extension_l(double x, double alpha) {
    const double t = (1 - alpha) * (1 - alpha);
    return mix(21.5473, 25.3245, t) /
               (1 + mix(3.82987, 3.32435, t) * std::pow(x, mix(0.19823, 0.16801, t))) +
           mix(-1.97760, -1.27393, t) * x + mix(-4.32054, -4.85967, t);
}

double extension_lambda(double cosine, double alpha) {
    return cosine < 0.5 ? std::exp(extension_l(cosine, alpha))
                        : std::exp(2 * extension_l(0.5, alpha) - extension_l(1 - cosine, alpha));
}

double extension_value(double alpha, const glm::dvec3& o, const glm::dvec3& i) {
    const glm::dvec3 h = glm::normalize(o + i);
    const double d =
        (2 + 1 / alpha) * std::pow(std::max(1 - h.z * h.z, 0.0), 0.5 / alpha) / (2 * pi);
    return d / ((1 + extension_lambda(o.z, alpha) + extension_lambda(i.z, alpha)) * 4 * o.z * i.z);
}

/// Integral of the value times the cosine over the hemisphere, by the midpoint rule.
double extension_albedo(double alpha, double cosine) {
    const glm::dvec3 o(std::sqrt(1 - cosine * cosine), 0, cosine);
    double sum = 0;
    const int rows = 500, columns = 200;
    for (int row = 0; row < rows; ++row) {
        const double theta = (row + 0.5) / rows * pi / 2;
        for (int column = 0; column < columns; ++column) {
            const double phi = (column + 0.5) / columns * pi;
            const glm::dvec3 i(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                               std::cos(theta));
            sum += extension_value(alpha, o, i) * i.z * std::sin(theta);
        }
    }
    return sum * pi / 2 / rows * 2 * pi / columns;
}

TEST(Sheen, AlbedoAgreesWithQuadrature) {
    for (const double roughness : {0.1, 0.15, 0.25, 0.4, 0.6, 0.8, 1.0}) {
        for (const double cosine : {0.004, 0.02, 0.06, 0.15, 0.3, 0.5, 0.7, 0.9, 0.999}) {
            const double alpha = roughness * roughness;
            const double expected = extension_albedo(alpha, cosine);
            EXPECT_NEAR(sheen_albedo(float(alpha), float(cosine)), expected,
                        0.005 * std::max(expected, 1.0))
                << roughness << ", " << cosine;
        }
    }
}

float value(double alpha, vec3 wo, vec3 wi) {
    const float a = float(alpha);
    return sheen_value(a, wo, wi, std::max(sheen_albedo(a, wo.z), sheen_albedo(a, wi.z)));
}

TEST(Sheen, ValueAgreesWithTheExtension) {
    std::mt19937 bits(101);
    for (int i = 0; i < 20'000; ++i) {
        const float roughness = 0.1f + 0.9f * to_unit_float(bits);
        const vec3 wo = any_upper(bits), wi = any_upper(bits);
        const double alpha = double(roughness) * double(roughness);
        // Where it would gain light, it is divided by its albedo.
        const double most = std::max({1.0, double(sheen_albedo(float(alpha), wo.z)),
                                      double(sheen_albedo(float(alpha), wi.z))});
        const double expected = extension_value(alpha, glm::dvec3(wo), glm::dvec3(wi)) / most;
        ASSERT_NEAR(value(alpha, wo, wi), expected, 5e-3 * expected + 1e-6) << "case " << i;
        ASSERT_EQ(value(alpha, wo, wi), value(alpha, wi, wo));
    }
}

MaterialRecord cloth(vec3 base, float sheen, float roughness) {
    MaterialRecord m = lambertian(base);
    m.sheen_r = m.sheen_g = m.sheen_b = sheen;
    m.sheen_roughness = roughness;
    return m;
}

TEST(Sheen, ScalesWhatIsBelow) {
    for (const float roughness : {0.3f, 0.7f}) {
        const MaterialRecord m = cloth(vec3(0.5f), 0.8f, roughness);
        const double alpha = double(roughness) * double(roughness);
        for (const double angle : {0.0, 40.0, 80.0}) {
            const vec3 wo = at_angle(angle), wi = at_angle(60, 50);
            const double o = extension_albedo(alpha, double(wo.z));
            const double i = extension_albedo(alpha, double(wi.z));
            const double expected = 0.8 * extension_value(alpha, glm::dvec3(wo), glm::dvec3(wi)) +
                                    0.5 / pi * (1 - 0.8 * std::min(std::max(o, i), 1.0));
            EXPECT_NEAR(bsdf_eval(m, wo, wi, LOBES_ALL).y, expected, 5e-3 * expected);
        }
    }
    EXPECT_EQ(bsdf_lobes(cloth(vec3(0), 0.5f, 0.5f)), LOBE_DIFFUSE);
    EXPECT_FALSE(is_lambertian(cloth(vec3(1), 0.5f, 0.5f)));
}

TEST(Sheen, GainsNoLightAndFollowsItsDensity) {
    for (const float roughness : {0.0f, 0.1f, 0.2f, 0.5f, 1.0f}) {
        for (const double angle : {0.0, 45.0, 75.0, 88.0}) {
            const MaterialRecord m = cloth(vec3(1), 1, roughness);
            const vec3 wo = at_angle(angle);
            Mean sum;
            for (int i = 0; i < 40'000; ++i) {
                BsdfSample s;
                const vec4 u = random4(102, uint(i), 0, 0);
                sum.add(bsdf_sample(m, wo, true, LOBES_ALL, u, s) ? double(s.weight.y) : 0);
            }
            SCOPED_TRACE(::testing::Message() << roughness << ", " << angle);
            EXPECT_LT(sum.value(), 1.01 + 5 * sum.deviation());
            // Midpoint rule over the angle, as light is scattered at grazing ones.
            double integral = 0;
            for (int row = 0; row < 600; ++row) {
                for (int column = 0; column < 100; ++column) {
                    const double theta = (row + 0.5) / 600 * 90;
                    const vec3 wi = at_angle(theta, (column + 0.5) * 1.8);
                    integral += double(bsdf_eval(m, wo, wi, LOBES_ALL).y * wi.z) *
                                std::sin(theta * pi / 180) * pi / 2 / 600 * 2 * pi / 100;
                }
            }
            EXPECT_NEAR(sum.value(), integral, 5 * sum.deviation() + 5e-3);
        }
    }
}

} // namespace
} // namespace argand
