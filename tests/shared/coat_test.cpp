// Coats of varnish (KHR_materials_clearcoat): their reflection against appendix B in double
// precision, what is below them, furnace, reciprocity and sampling.
#include "materials.hpp"
#include "microfacets.hpp"
#include "shared/random.h"
#include "statistics.hpp"

#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace argand::testing;

MaterialRecord coated(MaterialRecord m, float coat, float roughness) {
    m.coat = coat;
    m.coat_roughness = roughness;
    return m;
}

double schlick(double cosine) { return 0.04 + 0.96 * std::pow(1 - cosine, 5); }

vec3 coat_value(const MaterialRecord& m, vec3 wo, vec3 wi) {
    float pdf = 0;
    return coat_eval_and_pdf(m, wo, wi, pdf);
}

TEST(Coat, HasTheLobeOfItsRoughness) {
    const MaterialRecord base = lambertian(vec3(0.5f));
    EXPECT_EQ(bsdf_lobes(coated(base, 1, 0)), LOBE_DIFFUSE | LOBE_MIRROR);
    EXPECT_EQ(bsdf_lobes(coated(base, 0.01f, 0.5f)), LOBE_DIFFUSE | LOBE_COAT);
    EXPECT_EQ(bsdf_lobes(coated(base, 0, 0.5f)), LOBE_DIFFUSE);
    EXPECT_FALSE(is_lambertian(coated(base, 1, 0)));
}

TEST(Coat, ReflectsAsAppendixBDoes) {
    for (const float roughness : {0.1f, 0.4f, 1.0f}) {
        const double alpha = double(roughness) * double(roughness);
        const MaterialRecord m = coated(lambertian(vec3(0.5f)), 0.5f, roughness);
        for (const double angle : {0.0, 30.0, 70.0}) {
            for (const double off : {0.0, 10.0}) {
                const vec3 wo = at_angle(angle), wi = at_angle(angle + off, 180);
                const glm::dvec3 h = glm::normalize(glm::dvec3(wo) + glm::dvec3(wi));
                const double expected = 0.5 * schlick(glm::dot(glm::dvec3(wo), h)) *
                                        appendix_b::distribution(alpha, h.z) *
                                        appendix_b::visibility(alpha, double(wo.z), double(wi.z));
                // Repeated reflection adds less than 0.04^2.
                EXPECT_NEAR(coat_value(m, wo, wi).y, expected, 5e-3 * expected + 1e-3);
            }
        }
    }
}

TEST(Coat, ASmoothCoatIsAMirrorOverWhatIsBelow) {
    for (const double angle : {0.0, 45.0, 80.0}) {
        const vec3 wo = at_angle(angle), wi = at_angle(30, 100);
        const double f = 0.7 * schlick(double(wo.z)), f_i = 0.7 * schlick(double(wi.z));
        const MaterialRecord paint = coated(lambertian(vec3(0.5f)), 0.7f, 0);
        EXPECT_NEAR(bsdf_albedo(paint, wo, true, LOBE_MIRROR).y, f, 1e-6);
        const double passed = 1 - std::max(f, f_i);
        EXPECT_NEAR(bsdf_eval(paint, wo, wi, LOBES_ALL).y, 0.5 * passed * double(INV_PI), 1e-6);
        const MaterialRecord silver = coated(metal(vec3(0.9f), 0), 0.7f, 0);
        const double metal = 0.9 + 0.1 * std::pow(1 - double(wo.z), 5);
        EXPECT_NEAR(bsdf_albedo(silver, wo, true, LOBE_MIRROR).y, f + (1 - f) * metal, 1e-5);
        // Light leaves a solid at a smaller cosine than it arrives with.
        const MaterialRecord solid = coated(glass(1.5f, 1), 0.7f, 0);
        EXPECT_NEAR(bsdf_albedo(solid, wo, true, LOBES_DELTA).y, 1, 1e-5);
        const DeltaLobes inside = bsdf_delta_lobes(solid, wo, false);
        const double out = double(inside.cosine_refracted);
        const double bare = bsdf_delta_lobes(glass(1.5f, 1), wo, false).transmitted.y;
        EXPECT_NEAR(inside.transmitted.y, bare * (1 - 0.7 * schlick(out)), 1e-5);
    }
}

TEST(Coat, IsReciprocal) {
    std::mt19937 bits(91);
    for (int i = 0; i < 50'000; ++i) {
        const MaterialRecord m = any_coated(bits);
        const vec3 a = any_upper(bits), b = any_upper(bits);
        const vec3 there = bsdf_eval(m, a, b, LOBES_ALL), back = bsdf_eval(m, b, a, LOBES_ALL);
        const vec3 coat = coat_value(m, a, b), coat_back = coat_value(m, b, a);
        for (int k = 0; k < 3; ++k) {
            ASSERT_NEAR(there[k], back[k], 1e-5 * double(max_component(there))) << "case " << i;
            ASSERT_NEAR(coat[k], coat_back[k], 1e-5 * double(coat[k])) << "case " << i;
        }
    }
}

TEST(Coat, SinglePrecisionIsStable) {
    std::mt19937 bits(92);
    for (int i = 0; i < 100'000; ++i) {
        const MaterialRecord m = any_coated(bits);
        const vec3 wo = any_upper(bits), wi = any_upper(bits);
        const vec3 f = bsdf_eval(m, wo, wi, LOBES_ALL);
        const glm::dvec3 truth = truth::bsdf_eval(record_bytes(m), wo, wi, LOBES_ALL);
        const double alpha = std::max(double(ggx_alpha(m)), 1e-3);
        for (int k = 0; k < 3; ++k) {
            ASSERT_NEAR(f[k], truth[k], (2e-4 + 1e-6 / alpha) * double(max_component(f)) + 3e-7)
                << "case " << i;
        }
    }
}

/// Share of light from wo that is scattered.
Mean scattered(const MaterialRecord& m, vec3 wo, bool front, int samples) {
    Mean sum;
    for (int i = 0; i < samples; ++i) {
        BsdfSample s;
        const vec4 u = random4(93, uint(i), 0, 0);
        sum.add(bsdf_sample(m, wo, front, LOBES_ALL, u, s) ? double(s.weight.y) : 0);
    }
    return sum;
}

TEST(Coat, GainsNoLight) {
    std::mt19937 bits(94);
    for (int i = 0; i < 300; ++i) {
        MaterialRecord m = with_color(any_coated(bits), vec3(1));
        m.film = 0; // iridescence_test.cpp
        m.specular_g = 1;
        const vec3 wo = at_angle(double(bits() % 90));
        const Mean sum = scattered(m, wo, i % 3 != 0, 4000);
        EXPECT_LT(sum.value(), 1.015 + 5 * sum.deviation())
            << "case " << i << ": metallic " << m.metallic << ", roughness " << m.roughness
            << ", specular " << m.specular << " " << m.specular_r << ", transmission "
            << m.transmission << ", index " << m.ior << ", thickness " << m.thickness << ", coat "
            << m.coat << " " << m.coat_roughness << ", sheen " << m.sheen_g << " "
            << m.sheen_roughness << ", wo.z " << wo.z << ", front " << (i % 3 != 0);
    }
}

// What a coat takes at grazing angles of the light is lost below. Rough coats dim what is below as
// smooth ones do, though they reflect less at grazing angles.
TEST(Coat, LosesLittleLight) {
    for (const float roughness : {0.0f, 0.3f}) {
        for (const double angle : {0.0, 45.0, 75.0}) {
            const Mean sum =
                scattered(coated(lambertian(vec3(1)), 1, roughness), at_angle(angle), true, 20'000);
            EXPECT_GT(sum.value(), 0.94 - 5 * sum.deviation()) << roughness << ", " << angle;
        }
    }
}

TEST(Coat, SamplesFollowTheirDensity) {
    for (const float roughness : {0.3f, 0.5f, 1.0f}) {
        for (const double angle : {0.0, 50.0, 80.0}) {
            SCOPED_TRACE(::testing::Message() << roughness << ", " << angle);
            MaterialRecord m = coated(glass(1.5f, 0), 0.8f, roughness);
            m.roughness = 0.4f; // another lobe of its kind
            const vec3 wo = at_angle(angle, 40);
            // Moments of the cosine by samples and by quadrature over the half vector.
            Mean weights, cosines, kept;
            for (int i = 0; i < 60'000; ++i) {
                BsdfSample s;
                const bool counts =
                    bsdf_sample(m, wo, true, LOBES_SPREAD, random4(95, uint(i), 0, 0), s) &&
                    s.lobe == LOBE_COAT;
                weights.add(counts ? double(s.weight.y) : 0);
                cosines.add(counts ? double(s.weight.y * s.wi.z) : 0);
                kept.add(counts ? 1 : 0);
                if (counts) {
                    float pdf = 0;
                    spread_eval_and_pdf(m, wo, s.wi, true, LOBES_SPREAD, LOBE_COAT, pdf);
                    ASSERT_NEAR(s.pdf, pdf, 1e-5 * double(pdf));
                }
            }
            double weight = 0, cosine = 0, probability = 0;
            const int rows = 600, columns = 300;
            for (int row = 0; row < rows; ++row) {
                for (int column = 0; column < columns; ++column) {
                    const double theta = std::acos((row + 0.5) / rows);
                    const double phi = 360 * (column + 0.5) / columns;
                    const vec3 wi = at_angle(theta * 57.295779513082323, phi);
                    float pdf = 0;
                    const vec3 f =
                        spread_eval_and_pdf(m, wo, wi, true, LOBES_SPREAD, LOBE_COAT, pdf);
                    const double measure = 2 * 3.14159265358979 / (rows * columns);
                    weight += double(f.y * wi.z) * measure;
                    cosine += double(f.y * wi.z * wi.z) * measure;
                    probability += double(pdf) * measure;
                }
            }
            EXPECT_NEAR(weights.value(), weight, 5 * weights.deviation() + 2e-3 * weight);
            EXPECT_NEAR(cosines.value(), cosine, 5 * cosines.deviation() + 2e-3 * cosine);
            EXPECT_NEAR(kept.value(), probability, 5 * kept.deviation() + 2e-3 * probability);
        }
    }
}

// Coats with a normal of their own, tilted by this angle towards 40 degrees of azimuth.
MaterialRecord tilted(MaterialRecord m, double degrees) {
    const vec3 normal = at_angle(degrees, 40);
    m.coat_normal_x = normal.x;
    m.coat_normal_y = normal.y;
    m.coat_normal_z = normal.z;
    return m;
}

vec3 in_coat(const MaterialRecord& m, vec3 w) { return to_local(make_frame(coat_normal(m)), w); }

TEST(TiltedCoat, OfNoTiltIsTheCoat) {
    std::mt19937 bits(96);
    for (int i = 0; i < 10'000; ++i) {
        const MaterialRecord m = any_coated(bits);
        if (!(m.coat > 0) || m.coat_roughness < 0.04f) {
            continue; // a smooth one becomes a narrow lobe
        }
        const vec3 wo = any_upper(bits), wi = any_upper(bits);
        EXPECT_NEAR(coat_value(tilted(m, 0), wo, wi).y, coat_value(m, wo, wi).y,
                    1e-5 * double(coat_value(m, wo, wi).y));
        EXPECT_NEAR(bsdf_eval(tilted(m, 0), wo, wi, LOBES_ALL).y, bsdf_eval(m, wo, wi, LOBES_ALL).y,
                    1e-5 * double(bsdf_eval(m, wo, wi, LOBES_ALL).y));
    }
}

// The lobe of a coat about its own normal, weighted by the cosine with that normal.
TEST(TiltedCoat, IsACoatAboutItsNormal) {
    for (const double tilt : {10.0, 40.0}) {
        const MaterialRecord straight = coated(metal(vec3(0), 1), 0.5f, 0.4f);
        const MaterialRecord m = tilted(straight, tilt);
        for (const double angle : {0.0, 35.0}) {
            const vec3 wo = at_angle(angle, 130), wi = at_angle(50, 20);
            const vec3 coat_wo = in_coat(m, wo), coat_wi = in_coat(m, wi);
            const double expected = double(coat_value(straight, coat_wo, coat_wi).y * coat_wi.z);
            EXPECT_NEAR(double(coat_value(m, wo, wi).y * wi.z), expected, 1e-4 * expected);
            const double passed =
                1 - 0.5 * std::max(schlick(double(coat_wo.z)), schlick(double(coat_wi.z)));
            const MaterialRecord paint = tilted(coated(lambertian(vec3(0.5f)), 0.5f, 0.4f), tilt);
            EXPECT_NEAR(bsdf_eval(paint, wo, wi, LOBES_ALL).y, 0.5 * passed * double(INV_PI), 1e-6);
        }
    }
}

// Photons come from where eye paths go to: the cosines change places, all else is reciprocal.
TEST(TiltedCoat, IsReciprocalButForTheCosines) {
    std::mt19937 bits(97);
    for (int i = 0; i < 50'000; ++i) {
        const MaterialRecord m = tilted(any_coated(bits), double(bits() % 60));
        const vec3 a = any_upper(bits), b = any_upper(bits);
        const vec3 there = bsdf_eval(m, a, b, LOBES_ALL), back = bsdf_eval(m, b, a, LOBES_ALL);
        const double coat = double(coat_value(m, a, b).y / coat_cosines(m, b));
        const double coat_back = double(coat_value(m, b, a).y / coat_cosines(m, a));
        ASSERT_NEAR(coat, coat_back, 1e-4 * coat + 1e-12) << "case " << i;
        ASSERT_NEAR(there.y, back.y, 1e-5 * double(there.y)) << "case " << i;
    }
}

// Furnace: what is not lost behind the surface's horizon is what the coat reflects.
TEST(TiltedCoat, ReflectsWhatACoatReflects) {
    for (const float roughness : {0.0f, 0.3f, 0.6f}) {
        for (const double tilt : {5.0, 20.0}) {
            const MaterialRecord straight = coated(metal(vec3(0), 1), 1, roughness);
            const MaterialRecord m = tilted(straight, tilt);
            const vec3 wo = at_angle(30, 200);
            Mean found, expected;
            for (int i = 0; i < 40'000; ++i) {
                const vec4 u = random4(98, uint(i), 0, 0);
                BsdfSample s;
                const bool counts = bsdf_sample(m, wo, true, LOBE_COAT, u, s);
                found.add(counts ? double(s.weight.y) : 0);
                if (counts) {
                    float pdf = 0;
                    spread_eval_and_pdf(m, wo, s.wi, true, LOBE_COAT, LOBE_COAT, pdf);
                    ASSERT_NEAR(s.pdf, pdf, (roughness > 0 ? 1e-3 : 0.2) * double(pdf));
                }
                // About its own normal, without what goes below the surface.
                MaterialRecord rough = straight;
                rough.coat_roughness = std::max(roughness, 0.032f);
                const bool own = bsdf_sample(rough, in_coat(m, wo), true, LOBE_COAT, u, s);
                const bool above = own && to_world(make_frame(coat_normal(m)), s.wi).z > 0;
                expected.add(above ? double(s.weight.y) : 0);
            }
            EXPECT_NEAR(found.value(), expected.value(),
                        5 * (found.deviation() + expected.deviation()) + 1e-3)
                << roughness << ", " << tilt;
        }
    }
}

TEST(TiltedCoat, SmoothOneReflectsAboutItsNormal) {
    const MaterialRecord m = tilted(coated(lambertian(vec3(0.5f)), 1, 0), 20);
    EXPECT_EQ(bsdf_lobes(m), LOBE_DIFFUSE | LOBE_COAT);
    const vec3 wo = at_angle(10, 250), n = coat_normal(m);
    const vec3 ideal = n * (2 * dot3(wo, n)) - wo;
    int sampled = 0;
    for (int i = 0; i < 1000; ++i) {
        BsdfSample s;
        if (bsdf_sample(m, wo, true, LOBE_COAT, random4(99, uint(i), 0, 0), s)) {
            EXPECT_GT(dot3(s.wi, ideal), 0.98);
            EXPECT_EQ(s.lobe, LOBE_COAT);
            ++sampled;
        }
    }
    EXPECT_GT(sampled, 990);
}

// Where a coat mirrors the eye below the surface it is gone, and what is below it is seen.
TEST(TiltedCoat, MakesNoBlackEdges) {
    for (const float roughness : {0.0f, 0.3f}) {
        for (const double tilt : {10.0, 30.0, 60.0}) {
            for (double angle = 0; angle < 88; angle += 11) {
                for (const double turn : {40.0, 130.0, 220.0}) {
                    const MaterialRecord m =
                        tilted(coated(lambertian(vec3(1)), 1, roughness), tilt);
                    const Mean sum = scattered(m, at_angle(angle, turn), true, 4000);
                    EXPECT_GT(sum.value(), 0.5) << roughness << ", " << tilt << ", " << angle;
                    EXPECT_LT(sum.value(), 1.01 + 5 * sum.deviation());
                }
            }
        }
    }
}

} // namespace
} // namespace argand
