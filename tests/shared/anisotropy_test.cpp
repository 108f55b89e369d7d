// Anisotropic GGX reflection (KHR_materials_anisotropy) against the extension's formulas in double
// precision; reciprocity, rotation, furnace and precision.
#include "reciprocity.hpp"
#include "shared/random.h"
#include "statistics.hpp"

#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace argand::testing;

constexpr double pi = 3.14159265358979323846;

MaterialRecord brushed(float roughness, double strength, double degrees = 0) {
    MaterialRecord m = metal(vec3(1, 0.5f, 0), roughness);
    m.anisotropy_x = float(strength * std::cos(degrees * pi / 180));
    m.anisotropy_y = float(strength * std::sin(degrees * pi / 180));
    return m;
}

MaterialRecord any_brushed(std::mt19937& bits) {
    MaterialRecord m = any_coated(bits);
    const double strength = bits() % 3 == 0 ? 1 : double(to_unit_float(bits));
    const double turn = 2 * pi * double(to_unit_float(bits));
    m.anisotropy_x = float(strength * std::cos(turn));
    m.anisotropy_y = float(strength * std::sin(turn));
    return m;
}

/// D V of the extension's section "Individual lobes", the tangent being x.
double facets_by_the_extension(double roughness, double strength, const glm::dvec3& o,
                               const glm::dvec3& i) {
    const double ab = roughness * roughness;
    const double at = ab + (1 - ab) * strength * strength;
    const glm::dvec3 h = glm::normalize(o + i);
    const double a2 = at * ab;
    const glm::dvec3 f(ab * h.x, at * h.y, a2 * h.z);
    const double w2 = a2 / glm::dot(f, f);
    const double d = a2 * w2 * w2 / pi;
    const double v = i.z * glm::length(glm::dvec3(at * o.x, ab * o.y, o.z));
    const double l = o.z * glm::length(glm::dvec3(at * i.x, ab * i.y, i.z));
    return d * 0.5 / (v + l);
}

TEST(Anisotropy, AgreesWithTheExtension) {
    std::mt19937 bits(51);
    for (const float roughness : {0.1f, 0.4f, 0.9f}) {
        for (const double strength : {0.3, 0.8, 1.0}) {
            for (int k = 0; k < 200; ++k) {
                const vec3 o = any_upper(bits), i = any_upper(bits);
                const ReflectionParameters r = reflection_parameters(brushed(roughness, strength));
                real pdf = 0;
                const vec3 h = o + i;
                const double found = double(layer_facets(r, o, i, h, dot3(h, h), pdf));
                const double expected = facets_by_the_extension(double(roughness), strength, o, i);
                // The strength's square is rounded.
                ASSERT_NEAR(found, expected, 2e-4 * expected) << roughness << ", " << strength;
            }
        }
    }
}

// Metal reflects F D V and, of what facets reflect more than once, a part that does not depend on
// the azimuth.
TEST(Anisotropy, IsInTheBsdfOfMetal) {
    const MaterialRecord m = brushed(0.3f, 0.7), even = brushed(0.3f, 0);
    const vec3 o = at_angle(40, 20);
    EXPECT_EQ(bsdf_lobes(m), LOBE_GLOSSY);
    for (const double around : {0.0, 90.0, 200.0}) {
        const vec3 i = at_angle(35, around);
        const glm::dvec3 h = glm::normalize(glm::dvec3(o) + glm::dvec3(i));
        const double fresnel = 0.5 + 0.5 * std::pow(1 - glm::dot(glm::dvec3(o), h), 5);
        const double once = fresnel * facets_by_the_extension(0.3f, 0.7, o, i);
        const ReflectionParameters r = reflection_parameters(m);
        const double average = double(ggx_lost_average(r.alpha));
        const double more = double(repeated_color(r, r.alpha > 0 ? float(average) : 0).y) *
                            double(ggx_lost(r.alpha, o.z) * ggx_lost(r.alpha, i.z)) /
                            (pi * average);
        EXPECT_NEAR(bsdf_eval(m, o, i, LOBES_ALL).y, once + more, 1e-4 * once);
        EXPECT_NE(bsdf_eval(even, o, i, LOBES_ALL).y, bsdf_eval(m, o, i, LOBES_ALL).y);
    }
}

vec3 turned(vec3 v, double radians) {
    const double c = std::cos(radians), s = std::sin(radians);
    return rounded(
        {double(v.x) * c - double(v.y) * s, double(v.x) * s + double(v.y) * c, double(v.z)});
}

TEST(Anisotropy, TurnsWithItsDirection) {
    std::mt19937 bits(52);
    for (int k = 0; k < 1000; ++k) {
        const vec3 o = at_angle(double(bits() % 85), double(bits() % 360));
        const vec3 i = at_angle(double(bits() % 85), double(bits() % 360));
        const double degrees = double(bits() % 360);
        const vec3 f = bsdf_eval(brushed(0.4f, 0.8), o, i, LOBES_ALL);
        const vec3 g = bsdf_eval(brushed(0.4f, 0.8, degrees), turned(o, degrees * pi / 180),
                                 turned(i, degrees * pi / 180), LOBES_ALL);
        ASSERT_NEAR(f.x, g.x, 1e-4 * double(f.x));
        // The opposite direction is the same.
        const vec3 opposite = bsdf_eval(brushed(0.4f, 0.8, 180), o, i, LOBES_ALL);
        ASSERT_NEAR(f.x, opposite.x, 1e-4 * double(f.x));
    }
}

// Smooth brushed metal scatters along one direction, and is no mirror.
TEST(Anisotropy, OfSmoothMetalIsGloss) {
    EXPECT_EQ(bsdf_lobes(brushed(0, 0.5)), LOBE_GLOSSY);
    EXPECT_EQ(bsdf_lobes(brushed(0, 0.01)), LOBE_MIRROR); // its alpha is 0.0001
    EXPECT_EQ(bsdf_lobes(brushed(0, 0)), LOBE_MIRROR);
    const MaterialRecord m = brushed(0, 1);
    int across = 0;
    for (int k = 0; k < 1000; ++k) {
        BsdfSample s;
        const vec3 wo = at_angle(30);
        if (bsdf_sample(m, wo, true, LOBES_ALL, random4(53, uint(k), 0, 0), s)) {
            across += std::abs(s.wi.y) > 0.05f ? 1 : 0;
            EXPECT_TRUE(std::isfinite(max_component(s.weight)));
        }
    }
    EXPECT_LT(across, 400); // repeated reflection goes everywhere
}

TEST(Anisotropy, IsReciprocalAndInQueriesAndStable) {
    expect_reciprocal_and_stable(54, any_brushed);
}

/// Share of light from wo that is scattered; checks weights and densities of the samples.
Mean scattered(const MaterialRecord& m, vec3 wo, int samples) {
    Mean sum;
    for (int k = 0; k < samples; ++k) {
        BsdfSample s;
        const bool is = bsdf_sample(m, wo, true, LOBES_ALL, random4(55, uint(k), 0, 0), s);
        sum.add(is ? double(s.weight.y) : 0);
        if (is && k % 50 == 0) {
            const double pdf = double(bsdf_pdf(m, wo, s.wi, LOBES_ALL));
            EXPECT_NEAR(s.pdf, pdf, 1e-4 * pdf);
            const double f = double(bsdf_eval(m, wo, s.wi, LOBES_ALL).y);
            EXPECT_NEAR(s.weight.y, f * double(s.wi.z) / pdf, 1e-3 * double(s.weight.y));
        }
    }
    return sum;
}

/// Integral of the density over the hemisphere of wi, by half vectors that are dense where facets
/// are.
double integral_of_pdf(const MaterialRecord& m, vec3 wo) {
    const ReflectionParameters r = reflection_parameters(m);
    const vec2 alpha = brushed_alphas(r);
    const double ax = double(alpha.x), ay = double(alpha.y);
    double sum = 0;
    const int rows = 400, columns = 400;
    for (int row = 0; row < rows; ++row) {
        const double rest = 1 - (row + 0.5) / rows;
        const double t = std::sqrt(1 / (rest * rest) - 1); // slope in units of alpha
        for (int column = 0; column < columns; ++column) {
            const double around = 2 * pi * (column + 0.5) / columns;
            const glm::dvec3 slope(ax * t * std::cos(around), ay * t * std::sin(around), 1);
            const glm::dvec3 h = glm::normalize(slope);
            const double cosine = glm::dot(glm::dvec3(wo), h);
            const glm::dvec3 wi = 2 * cosine * h - glm::dvec3(wo);
            if (cosine <= 0 || wi.z <= 0) {
                continue;
            }
            // d slope area / d (row, turn), solid angle of h over it, that of wi over that of h
            const double measure = ax * ay / (rest * rest * rest) * h.z * h.z * h.z * 4 * cosine;
            sum += double(bsdf_pdf(m, wo, rounded(wi), LOBES_ALL)) * measure;
        }
    }
    return sum * 2 * pi / (rows * columns);
}

TEST(Furnace, BrushedMetalReturnsNearlyAllLight) {
    for (const double strength : {0.3, 0.6, 1.0}) {
        for (const float roughness : {0.1f, 0.3f, 0.6f}) {
            double mean = 0;
            int directions = 0;
            for (const double angle : {15.0, 45.0, 70.0}) {
                for (const double around : {0.0, 30.0, 60.0, 90.0}) {
                    MaterialRecord m = with_color(brushed(roughness, strength), vec3(1));
                    const vec3 wo = at_angle(angle, around);
                    const Mean sum = scattered(m, wo, 8000);
                    EXPECT_GT(sum.value(), 0.84)
                        << strength << ", " << roughness << ", " << angle << ", " << around;
                    EXPECT_LT(sum.value(), 1.08 + 5 * sum.deviation())
                        << strength << ", " << roughness << ", " << angle << ", " << around;
                    mean += sum.value();
                    ++directions;
                }
            }
            EXPECT_NEAR(mean / directions, 1, 0.03) << strength << ", " << roughness;
        }
    }
}

TEST(Anisotropy, DensitiesIntegrateToWhatIsNotLost) {
    for (const double strength : {0.4, 1.0}) {
        for (const double angle : {20.0, 65.0}) {
            const MaterialRecord m = brushed(0.4f, strength);
            const vec3 wo = at_angle(angle, 35);
            int above = 0;
            const int samples = 40'000;
            for (int k = 0; k < samples; ++k) {
                BsdfSample s;
                above += bsdf_sample(m, wo, true, LOBES_ALL, random4(56, uint(k), 0, 0), s) ? 1 : 0;
            }
            const double share = double(above) / samples;
            EXPECT_NEAR(integral_of_pdf(m, wo), share, 0.01) << strength << ", " << angle;
        }
    }
}

} // namespace
} // namespace argand
