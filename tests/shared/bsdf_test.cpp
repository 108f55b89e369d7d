#include "materials.hpp"
#include "microfacets.hpp"

#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace argand::testing;

/// bsdf_sample for a given choice of lobe.
BsdfSample sample_of(const MaterialRecord& m, vec3 wo, bool front, uint lobes, float choice,
                     bool* scattered) {
    BsdfSample s;
    *scattered = bsdf_sample(m, wo, front, lobes, vec4(choice, 0.3f, 0.6f, 0), s);
    return s;
}

void expect_near(vec3 a, glm::dvec3 b, double bound) {
    EXPECT_NEAR(a.x, b.x, bound);
    EXPECT_NEAR(a.y, b.y, bound);
    EXPECT_NEAR(a.z, b.z, bound);
}

TEST(Bsdf, LambertianIsExact) {
    std::mt19937 bits(1);
    for (int i = 0; i < 10'000; ++i) {
        const vec3 color(to_unit_float(bits), to_unit_float(bits), to_unit_float(bits));
        const MaterialRecord m = lambertian(color);
        ASSERT_EQ(bsdf_lobes(m), LOBE_DIFFUSE);
        const vec3 wo = any_upper(bits);
        const vec3 wi = any_upper(bits);
        ASSERT_EQ(bsdf_eval(m, wo, wi, LOBES_ALL), color * INV_PI);
        ASSERT_EQ(bsdf_pdf(m, wo, wi, LOBES_ALL), wi.z * INV_PI);
        ASSERT_EQ(bsdf_albedo(m, wo, true, LOBES_ALL), color);
        BsdfSample s;
        const vec4 u(to_unit_float(bits), to_unit_float(bits), to_unit_float(bits), 0);
        ASSERT_TRUE(bsdf_sample(m, wo, true, LOBES_ALL, u, s));
        ASSERT_EQ(s.weight, color);
        ASSERT_EQ(s.lobe, LOBE_DIFFUSE);
        ASSERT_EQ(s.eta_scale, 1.0f);
        ASSERT_EQ(s.wi, sample_cosine_hemisphere(vec2(u.y, u.z)));
        ASSERT_EQ(s.pdf, s.wi.z * INV_PI);
    }
}

TEST(Bsdf, MaterialsHaveTheirLobes) {
    EXPECT_EQ(bsdf_lobes(white_dielectric()), LOBE_DIFFUSE | LOBE_GLOSSY);
    EXPECT_EQ(bsdf_lobes(glossy_dielectric(0)), LOBE_DIFFUSE | LOBE_MIRROR);
    EXPECT_EQ(bsdf_lobes(metal(vec3(1), 0)), LOBE_MIRROR);
    EXPECT_EQ(bsdf_lobes(metal(vec3(1), 0.5f)), LOBE_GLOSSY);
    EXPECT_EQ(bsdf_lobes(glass(1.5f, 0)), LOBE_MIRROR | LOBE_TRANSMIT);
    EXPECT_EQ(bsdf_lobes(glass(1.5f, 1)), LOBE_MIRROR | LOBE_TRANSMIT);
    EXPECT_EQ(bsdf_lobes(lambertian(vec3(0))), 0u);
    MaterialRecord m = glass(1.5f, 0);
    m.roughness = 0.5f;
    EXPECT_EQ(bsdf_lobes(m), LOBE_GLOSSY | LOBE_CLEAR);
    m.transmission = 0.5f;
    EXPECT_EQ(bsdf_lobes(m), LOBE_DIFFUSE | LOBE_GLOSSY | LOBE_CLEAR);
    m.metallic = 1;
    EXPECT_EQ(bsdf_lobes(m), LOBE_GLOSSY);
    EXPECT_TRUE(roughness_is_delta(glossy_dielectric(0.03f)));
    EXPECT_FALSE(roughness_is_delta(glossy_dielectric(0.032f)));
}

TEST(Bsdf, AlphaScalesAllLobes) {
    std::mt19937 bits(7);
    for (int i = 0; i < 20'000; ++i) {
        const MaterialRecord opaque = with_alpha(any_material(bits), 1);
        const float alpha = std::max(to_unit_float(bits), 1e-3f);
        const MaterialRecord m = with_alpha(opaque, alpha);
        ASSERT_EQ(pass_share(opaque), 0);
        ASSERT_EQ(pass_share(m), 1 - alpha);
        ASSERT_EQ(bsdf_lobes(m), bsdf_lobes(opaque));
        const vec3 wo = any_upper(bits);
        const vec3 wi = any_upper(bits);
        const vec3 f = bsdf_eval(opaque, wo, wi, LOBES_ALL);
        expect_near(bsdf_eval(m, wo, wi, LOBES_ALL), glm::dvec3(f) * double(alpha),
                    2e-6 * max_component(f));
        for (const uint lobe : {LOBE_DIFFUSE, LOBE_GLOSSY, LOBE_MIRROR, LOBE_TRANSMIT}) {
            expect_near(bsdf_albedo(m, wo, true, lobe),
                        glm::dvec3(bsdf_albedo(opaque, wo, true, lobe)) * double(alpha), 1e-6);
        }
    }
    EXPECT_EQ(bsdf_lobes(with_alpha(glossy_dielectric(0.5f), 0)), 0u);
}

TEST(Bsdf, EmptyMaskScattersNothing) {
    BsdfSample s;
    EXPECT_FALSE(bsdf_sample(lambertian(vec3(0)), vec3(0, 0, 1), true, LOBES_ALL, vec4(0.5f), s));
    EXPECT_FALSE(bsdf_sample(white_dielectric(), vec3(0, 0, 1), true, LOBES_DELTA, vec4(0.5f), s));
    EXPECT_FALSE(bsdf_sample(white_dielectric(), vec3(0, 0, -1), true, LOBES_ALL, vec4(0.5f), s));
    EXPECT_EQ(bsdf_eval(white_dielectric(), vec3(0, 0, 1), at_angle(100), LOBES_ALL), vec3(0));
    EXPECT_EQ(bsdf_pdf(white_dielectric(), vec3(0, 0, 1), at_angle(100), LOBES_ALL), 0.0f);
    EXPECT_EQ(bsdf_eval(glass(1.5f, 1), vec3(0, 0, 1), at_angle(10), LOBES_ALL), vec3(0));
}

TEST(Bsdf, IsReciprocal) {
    std::mt19937 bits(2);
    for (int i = 0; i < 100'000; ++i) {
        const MaterialRecord m = any_material(bits);
        const vec3 a = any_upper(bits);
        const vec3 b = any_upper(bits);
        const vec3 f = bsdf_eval(m, a, b, LOBES_ALL);
        const vec3 g = bsdf_eval(m, b, a, LOBES_ALL);
        for (int k = 0; k < 3; ++k) {
            ASSERT_NEAR(f[k], g[k], 2e-6 * f[k]) << "case " << i;
        }
    }
}

TEST(Bsdf, LobesAddUp) {
    std::mt19937 bits(3);
    for (int i = 0; i < 20'000; ++i) {
        const MaterialRecord m = any_material(bits);
        const vec3 a = any_upper(bits);
        const vec3 b = any_upper(bits);
        const vec3 sum = bsdf_eval(m, a, b, LOBE_DIFFUSE) + bsdf_eval(m, a, b, LOBE_GLOSSY);
        expect_near(bsdf_eval(m, a, b, LOBES_ALL), sum, 1e-6 * max_component(sum));
    }
}

/// Shares of light that microfacets with Schlick's reflectance return by single reflection, by
/// quadrature.
struct Albedos {
    double once, layer;
};
Albedos albedos(double alpha, double cosine, double f0) {
    return {
        appendix_b::albedo(
            alpha, cosine, [](double) { return 1.0; }, 300, 100),
        appendix_b::albedo(
            alpha, cosine, [&](double c) { return f0 + (1 - f0) * std::pow(1 - c, 5); }, 300, 100)};
}
Albedos mean_albedos(double alpha, double f0) {
    Albedos mean{};
    const int steps = 40;
    for (int i = 0; i < steps; ++i) {
        const double root = (i + 0.5) / steps;
        const Albedos a = albedos(alpha, root * root, f0);
        mean.once += a.once * 4 * root * root * root / steps;
        mean.layer += a.layer * 4 * root * root * root / steps;
    }
    return mean;
}

// GGX of glTF's appendix B, repeated reflection by Kulla and Conty 2017, and the diffuse lobe of
// Shirley et al. 1997, implemented independently for one pair of directions.
TEST(Bsdf, DielectricAgreesWithItsFormulas) {
    for (const double roughness : {0.1, 0.5, 1.0}) {
        const MaterialRecord m = glossy_dielectric(float(roughness));
        const double alpha = roughness * roughness, f0 = 0.04;
        const Albedos mean = mean_albedos(alpha, f0);
        const double schlick = f0 + (1 - f0) / 21;
        const double color = schlick * schlick * mean.once / (1 - schlick * (1 - mean.once));
        const auto reflected = [&](const Albedos& a) { return a.layer + color * (1 - a.once); };
        for (const double angle : {0.0, 30.0, 80.0}) {
            const vec3 wo = at_angle(angle), wi = at_angle(55, 20);
            const glm::dvec3 v(wo), l(wi);
            const glm::dvec3 h = glm::normalize(v + l);
            const Albedos o = albedos(alpha, v.z, f0), i = albedos(alpha, l.z, f0);
            const double single = (f0 + (1 - f0) * std::pow(1 - glm::dot(v, h), 5)) *
                                  appendix_b::distribution(alpha, h.z) *
                                  appendix_b::visibility(alpha, v.z, l.z);
            const double repeated =
                color * (1 - o.once) * (1 - i.once) / (1 - mean.once) / appendix_b::pi;
            const glm::dvec3 base(m.base_r, m.base_g, m.base_b);
            const glm::dvec3 diffuse = base / appendix_b::pi * (1 - reflected(o)) *
                                       (1 - reflected(i)) / (1 - reflected(mean));
            expect_near(bsdf_eval(m, wo, wi, LOBE_DIFFUSE), diffuse, 0.01 * diffuse.x);
            expect_near(bsdf_eval(m, wo, wi, LOBE_GLOSSY), glm::dvec3(single + repeated),
                        0.002 * (single + diffuse.x));
        }
    }
}

TEST(Bsdf, MetalAgreesWithTheSpecification) {
    bool scattered = false;
    for (const double angle : {0.0, 30.0, 60.0, 89.0, 89.99}) {
        const vec3 color(0.9f, 0.6f, 0.3f);
        const vec3 wo = at_angle(angle);
        const BsdfSample s = sample_of(metal(color, 0), wo, true, LOBES_ALL, 0.5f, &scattered);
        ASSERT_TRUE(scattered);
        EXPECT_EQ(s.lobe, LOBE_MIRROR);
        EXPECT_EQ(s.pdf, 0.0f);
        EXPECT_EQ(s.wi, vec3(-wo.x, -wo.y, wo.z));
        expect_near(s.weight,
                    glm::dvec3(color) + (1.0 - glm::dvec3(color)) * std::pow(1 - double(wo.z), 5),
                    1e-6);
    }
}

TEST(Bsdf, SpecularExtensionScalesTheLayer) {
    MaterialRecord m = glossy_dielectric(0);
    m.specular = 0.5f;
    m.specular_r = 2;
    m.specular_g = 40; // f0 is clamped to 1
    expect_near(bsdf_albedo(m, vec3(0, 0, 1), true, LOBE_MIRROR), glm::dvec3(0.04, 0.5, 0.02),
                1e-6);
    const vec3 grazing = bsdf_albedo(m, at_angle(89.999), true, LOBE_MIRROR);
    expect_near(grazing, glm::dvec3(0.5), 1e-4);
    m.ior = 0;
    m.specular_r = 1;
    expect_near(bsdf_albedo(m, at_angle(20), true, LOBE_MIRROR), glm::dvec3(0.5), 1e-5);
}

TEST(Bsdf, ThinGlassTransmitsStraight) {
    bool scattered = false;
    const MaterialRecord m = with_color(glass(1.5f, 0), vec3(1, 0.5f, 0.25f));
    for (const double angle : {0.0, 45.0, 80.0}) {
        for (const bool front : {false, true}) {
            const vec3 wo = at_angle(angle, 33);
            const double fresnel = 0.04 + 0.96 * std::pow(1 - double(wo.z), 5);
            const BsdfSample t = sample_of(m, wo, front, LOBE_TRANSMIT, 0.5f, &scattered);
            ASSERT_TRUE(scattered);
            expect_near(t.wi, -glm::dvec3(wo), 1e-7);
            expect_near(t.weight, (1 - fresnel) * glm::dvec3(1, 0.5, 0.25), 1e-6);
            EXPECT_EQ(t.eta_scale, 1.0f);
            const BsdfSample r = sample_of(m, wo, front, LOBE_MIRROR, 0.5f, &scattered);
            ASSERT_TRUE(scattered);
            expect_near(r.weight, glm::dvec3(fresnel), 1e-6);
        }
    }
}

/// Fresnel's equations in terms of the angles.
double fresnel_by_angles(double sine_in, double eta) {
    const double in = std::asin(sine_in);
    const double out = std::asin(sine_in / eta);
    if (in < 1e-6) {
        return (1 - eta) * (1 - eta) / ((1 + eta) * (1 + eta));
    }
    const double s = std::sin(in - out) / std::sin(in + out);
    const double p = std::tan(in - out) / std::tan(in + out);
    return 0.5 * (s * s + p * p);
}

TEST(Bsdf, SolidGlassFollowsSnellAndFresnel) {
    bool scattered = false;
    for (const float ior : {1.0f, 1.33f, 1.5f, 2.4f}) {
        const MaterialRecord m = glass(ior, 1);
        for (double angle = 0; angle < 90; angle += 0.7) {
            for (const bool front : {true, false}) {
                const vec3 wo = at_angle(angle, 200);
                const double eta = front ? double(ior) : 1 / double(ior);
                const double sine = std::hypot(double(wo.x), double(wo.y));
                const BsdfSample t = sample_of(m, wo, front, LOBE_TRANSMIT, 0.5f, &scattered);
                const BsdfSample both = sample_of(m, wo, front, LOBES_ALL, 0.999999f, &scattered);
                expect_near(both.weight, glm::dvec3(1), 1e-6);
                const double margin = 1 - sine / eta;
                if (margin < 1e-4) { // total internal reflection
                    if (margin < -1e-6) {
                        EXPECT_EQ(both.lobe, LOBE_MIRROR);
                        EXPECT_EQ(bsdf_albedo(m, wo, front, LOBE_MIRROR), vec3(1));
                        EXPECT_EQ(bsdf_albedo(m, wo, front, LOBE_TRANSMIT), vec3(0));
                        EXPECT_EQ(t.weight, vec3(0));
                    }
                    continue;
                }
                expect_near(t.wi,
                            glm::dvec3(-double(wo.x) / eta, -double(wo.y) / eta,
                                       -std::sqrt(1 - sine * sine / eta / eta)),
                            1e-5);
                EXPECT_NEAR(glm::length(glm::dvec3(t.wi)), 1, 1e-6);
                EXPECT_NEAR(t.eta_scale, 1 / eta / eta, 1e-6);
                expect_near(t.weight, glm::dvec3(1 - fresnel_by_angles(sine, eta)), 2e-4);
                const vec3 sum = bsdf_albedo(m, wo, front, LOBES_DELTA);
                expect_near(sum, glm::dvec3(1), 1e-6);
            }
        }
    }
}

TEST(Fresnel, AgreesWithTheEquationsInAngles) {
    for (const double eta : {0.5, 0.8, 1.000001, 1.2, 1.5, 3.0}) {
        for (double angle = 0.5; angle < 90; angle += 0.5) {
            const double sine = std::sin(angle * 0.017453292519943295);
            float refracted = 0;
            const float f = fresnel_dielectric(float(std::cos(angle * 0.017453292519943295)),
                                               float(eta), refracted);
            if (sine / eta > 1.00001) {
                EXPECT_EQ(f, 1.0f);
                EXPECT_EQ(refracted, 0.0f);
            } else if (sine / eta < 0.999) {
                EXPECT_NEAR(f, fresnel_by_angles(sine, eta), 1e-5)
                    << "eta " << eta << ", angle " << angle;
                EXPECT_NEAR(refracted, std::sqrt(1 - sine * sine / eta / eta), 1e-5);
            }
        }
    }
}

TEST(Fresnel, IndexOfOneIsInvisible) {
    for (const float cosine : {1.0f, 0.5f, 1e-3f, 1e-5f, 1e-10f}) {
        float refracted = 0;
        EXPECT_EQ(fresnel_dielectric(cosine, 1.0f, refracted), 0.0f);
        EXPECT_FLOAT_EQ(refracted, cosine);
    }
}

TEST(Fresnel, BothSidesReflectAlike) {
    for (double angle = 0; angle < 89; angle += 1) {
        float inside = 0;
        float outside = 0;
        const float r = fresnel_dielectric(at_angle(angle).z, 1.5f, inside);
        EXPECT_NEAR(fresnel_dielectric(inside, 1 / 1.5f, outside), r, 1e-5);
        EXPECT_NEAR(outside, at_angle(angle).z, 1e-5);
    }
}

TEST(Bsdf, IndexOfZeroReflectsAllLight) {
    const MaterialRecord m = glass(0, 1);
    for (const double angle : {0.0, 40.0, 89.0}) {
        EXPECT_EQ(bsdf_albedo(m, at_angle(angle), true, LOBE_MIRROR), vec3(1));
        EXPECT_EQ(bsdf_albedo(m, at_angle(angle), true, LOBE_TRANSMIT), vec3(0));
    }
}

// The same code in single and in double precision, at all angles and roughnesses.
TEST(Bsdf, SinglePrecisionIsStable) {
    std::mt19937 bits(5);
    for (int i = 0; i < 200'000; ++i) {
        const MaterialRecord m = any_material(bits);
        const vec3 wo = any_upper(bits);
        const vec3 wi = any_upper(bits);
        const vec3 f = bsdf_eval(m, wo, wi, LOBES_ALL);
        const glm::dvec3 f_truth = truth::bsdf_eval(record_bytes(m), wo, wi, LOBES_ALL);
        const float pdf = bsdf_pdf(m, wo, wi, LOBES_ALL);
        const double pdf_truth = truth::bsdf_pdf(record_bytes(m), wo, wi, LOBES_ALL);
        // Near the peak, the rounding of the half vector counts relative to the peak's width.
        const double alpha = std::max(double(m.roughness) * m.roughness, 1e-3);
        const double bound = 4e-6 + 1e-6 / alpha;
        for (int k = 0; k < 3; ++k) {
            ASSERT_NEAR(f[k], f_truth[k], bound * f_truth[k]) << "case " << i;
        }
        ASSERT_NEAR(pdf, pdf_truth, bound * pdf_truth) << "case " << i;
    }
}

TEST(Bsdf, SinglePrecisionSamplesLikeDouble) {
    std::mt19937 bits(6);
    int compared = 0;
    for (int i = 0; i < 200'000; ++i) {
        const MaterialRecord m = any_material(bits);
        const vec3 wo = any_upper(bits);
        const bool front = bits() % 2 == 0;
        const vec4 u(to_unit_float(bits), to_unit_float(bits), to_unit_float(bits), 0);
        BsdfSample s;
        const bool scattered = bsdf_sample(m, wo, front, LOBES_ALL, u, s);
        const truth::BsdfSample t = truth::bsdf_sample(record_bytes(m), wo, front, LOBES_ALL, u);
        if (!scattered || !t.scattered || s.lobe != t.lobe ||
            std::min(t.wi.z, double(s.wi.z)) < 0.01) {
            continue; // at the boundary between two lobes, or at the horizon
        }
        ++compared;
        // If u.z is near 1, at the rim of the normals visible from wo, their height is a small
        // difference.
        ASSERT_NEAR(glm::length(glm::dvec3(s.wi) - t.wi), 0, 4e-5 + 1e-8 / (1 - double(u.z)))
            << "case " << i;
        ASSERT_EQ(s.weight.x >= 0, true);
        const double alpha = std::max(double(m.roughness) * m.roughness, 1e-3);
        for (int k = 0; k < 3; ++k) {
            ASSERT_NEAR(s.weight[k], t.weight[k], (2e-4 + 1e-5 / alpha) * (t.weight[k] + 0.03))
                << "case " << i;
        }
    }
    EXPECT_GT(compared, 100'000);
}

} // namespace
} // namespace argand
