// The clear lobe of rough glass against Walter et al. 2007 and KHR_materials_transmission in double
// precision, its sampling, its furnace and its reciprocity.
#include "materials.hpp"
#include "microfacets.hpp"
#include "shared/random.h"
#include "statistics.hpp"

#include <gtest/gtest.h>
#include <numeric>

namespace argand {
namespace {

using namespace argand::testing;

constexpr double pi = 3.14159265358979323846;

MaterialRecord rough_glass(float roughness, float ior, bool solid) {
    MaterialRecord m = glass(ior, solid ? 1.0f : 0.0f);
    m.roughness = roughness;
    return m;
}

vec3 value(const MaterialRecord& m, vec3 wo, vec3 wi, bool front) {
    float pdf = 0;
    return rough_clear_eval_and_pdf(m, wo, wi, front, pdf);
}

/// Fresnel's equations by Snell's law, in double precision.
double fresnel(double cosine, double eta) {
    const double sine2 = (1 - cosine * cosine) / (eta * eta);
    if (sine2 >= 1) {
        return 1;
    }
    const double refracted = std::sqrt(1 - sine2);
    const double s = (cosine - eta * refracted) / (cosine + eta * refracted);
    const double p = (eta * cosine - refracted) / (eta * cosine + refracted);
    return 0.5 * (s * s + p * p);
}

/// Walter's equations 20 and 21, for radiance; wo on the side of index 1, wi on that of index eta.
double walter(double alpha, double eta, glm::dvec3 wo, glm::dvec3 wi) {
    const bool reflects = wi.z > 0;
    glm::dvec3 h = reflects ? wo + wi : -(wo + eta * wi);
    h = glm::normalize(h);
    h = h.z < 0 ? -h : h;
    const double o = glm::dot(wo, h), i = glm::dot(wi, h);
    if (o <= 0 || (i > 0) != reflects) {
        return 0;
    }
    const double d = appendix_b::distribution(alpha, h.z);
    const double g_over_4 = appendix_b::visibility(alpha, wo.z, std::abs(wi.z));
    if (reflects) {
        return fresnel(o, eta) * d * g_over_4;
    }
    const double sum = eta * i + o;
    return std::abs(i * o) * 4 * g_over_4 * (1 - fresnel(o, eta)) * d / (sum * sum);
}

/// A direction on either side.
vec3 any_side(std::mt19937& bits) {
    vec3 v = any_upper(bits);
    v.z = bits() % 3 == 0 ? v.z : -v.z;
    return v;
}

TEST(RoughGlass, SolidsFollowWalter) {
    std::mt19937 bits(81);
    int compared = 0;
    for (int i = 0; i < 100'000; ++i) {
        const float roughness = std::array{0.1f, 0.2f, 0.5f, 1.0f}[bits() % 4];
        const float ior = std::array{1.2f, 1.5f, 2.4f}[bits() % 3];
        const MaterialRecord m = rough_glass(roughness, ior, true);
        const bool front = bits() % 2 == 0;
        const vec3 wo = any_upper(bits), wi = any_side(bits);
        const double eta = front ? double(ior) : 1 / double(ior);
        // Values are for flux.
        const double scale = wi.z > 0 ? 1 : eta * eta;
        const double expected =
            scale * walter(double(ggx_alpha(m)), eta, glm::dvec3(wo), glm::dvec3(wi));
        double pdf = 0;
        const double found = truth::rough_clear_eval_and_pdf(record_bytes(m), wo, wi, front, pdf).y;
        ASSERT_NEAR(found, expected, 1e-4 * expected + 1e-9) << "case " << i;
        compared += expected > 0 ? 1 : 0;
    }
    EXPECT_GT(compared, 40'000);
}

TEST(RoughGlass, ThinWallsAreReflectionsOnTheOtherSide) {
    for (const float roughness : {0.05f, 0.3f, 0.6f, 1.0f}) {
        const MaterialRecord m = with_color(rough_glass(roughness, 1.5f, false), {1, 0.5f, 0.25f});
        const double alpha = double(ggx_alpha(m));
        const auto one = [](double) { return 1.0; };
        const double lost_mean =
            double(ggx_lost_average(float(alpha))); // tested by ggx_energy_test
        const double f0 = 0.04, f_mean = f0 + (1 - f0) / 21;
        const double returned = f_mean * f_mean * (1 - lost_mean) / (1 - f_mean * lost_mean);
        for (const double angle : {0.0, 40.0, 75.0}) {
            for (const double off : {0.0, 10.0, 50.0}) {
                const vec3 wo = at_angle(angle, 200), up = at_angle(std::abs(angle - off), 20);
                const glm::dvec3 v(wo), l(up);
                const glm::dvec3 h = glm::normalize(v + l);
                const double f = f0 + (1 - f0) * std::pow(1 - glm::dot(v, h), 5);
                const double once = (1 - f) * appendix_b::distribution(alpha, h.z) *
                                    appendix_b::visibility(alpha, v.z, l.z);
                const double repeated = (1 - returned) * (1 - appendix_b::albedo(alpha, v.z, one)) *
                                        (1 - appendix_b::albedo(alpha, l.z, one)) /
                                        (pi * lost_mean);
                for (const bool front : {true, false}) {
                    const vec3 found = value(m, wo, vec3(up.x, up.y, -up.z), front);
                    // The fits of what is lost are good to 0.003 of 1.
                    const double bound = 2e-3 * once + 0.01;
                    EXPECT_NEAR(found.x, once + repeated, bound) << roughness << ", " << angle;
                    EXPECT_NEAR(found.y, 0.5 * (once + repeated), bound);
                    EXPECT_NEAR(found.z, 0.25 * (once + repeated), bound);
                    EXPECT_EQ(value(m, wo, up, front), vec3(0));
                }
            }
        }
    }
}

TEST(RoughGlass, SmoothGlassStaysADelta) {
    for (const bool solid : {false, true}) {
        EXPECT_EQ(bsdf_lobes(rough_glass(0.031f, 1.5f, solid)), LOBE_MIRROR | LOBE_TRANSMIT);
        EXPECT_EQ(bsdf_lobes(rough_glass(0.033f, 1.5f, solid)),
                  solid ? LOBE_TRANSMIT | LOBE_MIRROR : LOBE_CLEAR | LOBE_GLOSSY);
        EXPECT_EQ(bsdf_lobes(rough_glass(0.05f, 1.5f, solid)),
                  solid ? LOBE_CLEAR : LOBE_CLEAR | LOBE_GLOSSY);
    }
    // Solids of the index of air turn no light, however rough.
    EXPECT_EQ(bsdf_lobes(rough_glass(1, 1, true)), LOBE_TRANSMIT | LOBE_MIRROR);
    EXPECT_EQ(bsdf_lobes(rough_glass(1, 1, false)), LOBE_CLEAR | LOBE_GLOSSY);
    EXPECT_EQ(bsdf_lobes(rough_glass(1, 0, true)), LOBE_CLEAR);
}

// Flux that goes the other way: eta² less (Walter, §5.2).
TEST(RoughGlass, IsReciprocal) {
    std::mt19937 bits(82);
    for (int i = 0; i < 50'000; ++i) {
        MaterialRecord m = any_material(bits);
        m.transmission = 1;
        m.metallic = 0;
        const vec3 wo = any_upper(bits), wi = any_side(bits);
        const bool front = bits() % 2 == 0, passes = wi.z < 0;
        const vec3 there = value(m, wo, wi, front);
        const vec3 back = passes
                              ? value(m, vec3(wi.x, wi.y, -wi.z), vec3(wo.x, wo.y, -wo.z), !front)
                              : value(m, wi, wo, front);
        const float eta = passes ? interface_eta(m, front) : 1;
        const double alpha = std::max(double(ggx_alpha(m)), 1e-3);
        const double turned = is_solid(m) ? std::abs(double(m.ior) - 1) : 1;
        for (int k = 0; k < 3; ++k) {
            const double expected = double(eta) * double(eta) * double(back[k]);
            // Near the critical angle, rounded directions change Fresnel's factor by their root.
            ASSERT_NEAR(there[k], expected, (2e-3 + 1e-5 / (alpha * turned)) * expected + 1e-5)
                << "case " << i;
        }
    }
}

/// Share of light from wo that is scattered, by the samples' weights.
Mean scattered(const MaterialRecord& m, vec3 wo, bool front, uint lobes, int samples) {
    Mean sum;
    for (int i = 0; i < samples; ++i) {
        BsdfSample s;
        const bool goes_on = bsdf_sample(m, wo, front, lobes, random4(83, uint(i), 0, 0), s);
        sum.add(goes_on ? double(s.weight.y) : 0);
    }
    return sum;
}

TEST(RoughGlass, WhiteThinWallsLoseNoLight) {
    for (const float roughness : {0.05f, 0.25f, 0.5f, 0.75f, 1.0f}) {
        for (const double angle : {0.0, 45.0, 75.0, 85.0}) {
            const Mean sum = scattered(rough_glass(roughness, 1.5f, false), at_angle(angle), true,
                                       LOBES_ALL, 20'000);
            EXPECT_NEAR(sum.value(), 1, 0.015 + 5 * sum.deviation()) << roughness << ", " << angle;
        }
    }
}

// What facets send into others is lost: most at roughness 1.
TEST(RoughGlass, SolidsGainNoLight) {
    for (const float ior : {1.05f, 1.5f, 2.4f}) {
        for (const float roughness : {0.2f, 0.5f, 1.0f}) {
            for (const double angle : {0.0, 45.0, 75.0, 89.0}) {
                for (const bool front : {true, false}) {
                    const MaterialRecord m = rough_glass(roughness, ior, true);
                    const Mean sum = scattered(m, at_angle(angle), front, LOBES_ALL, 10'000);
                    SCOPED_TRACE(::testing::Message() << ior << ", " << roughness << ", " << angle
                                                      << ", " << front << ": " << sum.value());
                    EXPECT_LT(sum.value(), 1.0001);
                    const double least = roughness < 0.3f ? 0.85 : roughness < 0.6f ? 0.4 : 0.15;
                    EXPECT_GT(sum.value(), least);
                }
            }
        }
    }
}

/// Cells of directions around an axis, finer near it: rows in the root of the angle.
class Cells {
public:
    explicit Cells(glm::dvec3 axis) : frame_(make_frame(rounded(axis))) {}

    std::size_t count() const { return rows * columns; }

    std::size_t cell_of(vec3 wi) const {
        const glm::dvec3 v(to_local(frame_, wi));
        const double angle = std::atan2(std::hypot(v.x, v.y), v.z);
        const double turn = std::atan2(v.y, v.x) / (2 * pi) + 0.5;
        const auto row = std::min(rows - 1, std::size_t(rows * std::sqrt(angle / pi)));
        return row * columns + std::min(columns - 1, std::size_t(columns * turn));
    }

    template <class F> std::vector<double> integrate(const F& f) const {
        std::vector<double> integrals(count());
        const int steps = 24;
        for (std::size_t cell = 0; cell < count(); ++cell) {
            for (int i = 0; i < steps * steps; ++i) {
                const double root = (double(cell / columns) + (i / steps + 0.5) / steps) / rows;
                const double turn = (double(cell % columns) + (i % steps + 0.5) / steps) / columns;
                const double angle = pi * root * root, around = 2 * pi * (turn - 0.5);
                const vec3 wi = to_world(
                    frame_, rounded({std::sin(angle) * std::cos(around),
                                     std::sin(angle) * std::sin(around), std::cos(angle)}));
                const double measure = 2 * pi * root * std::sin(angle) * 2 * pi;
                integrals[cell] += f(wi) * measure / double(count() * steps * steps);
            }
        }
        return integrals;
    }

private:
    static constexpr std::size_t rows = 16, columns = 12;
    Frame frame_;
};

/// Compares the samples on one side with their density and value there.
void expect_sampling_to_match(const MaterialRecord& m, vec3 wo, bool front, bool passes) {
    SCOPED_TRACE(::testing::Message() << "roughness " << m.roughness << ", index " << m.ior
                                      << ", solid " << (m.thickness > 0) << ", wo.z " << wo.z
                                      << ", front " << front << ", passes " << passes);
    const double eta = double(interface_eta(m, front));
    const glm::dvec3 o(wo);
    const glm::dvec3 mirrored(-o.x, -o.y, o.z);
    const double sine2 = (1 - o.z * o.z) / (eta * eta);
    const glm::dvec3 refracted(-o.x / eta, -o.y / eta, -std::sqrt(std::max(1 - sine2, 0.0)));
    const Cells cells(glm::normalize(passes ? refracted : mirrored));
    const auto here = [&](vec3 wi) { return (wi.z < 0) == passes; };
    const std::vector<double> density = cells.integrate([&](vec3 wi) {
        double pdf = 0;
        truth::rough_clear_eval_and_pdf(record_bytes(m), wo, wi, front, pdf);
        return here(wi) ? pdf : 0;
    });
    const std::vector<double> values = cells.integrate([&](vec3 wi) {
        double pdf = 0;
        const auto f = truth::rough_clear_eval_and_pdf(record_bytes(m), wo, wi, front, pdf);
        return here(wi) ? f.x * std::abs(double(wi.z)) : 0;
    });
    std::vector<double> counts(cells.count());
    Mean weight;
    const int samples = 40'000;
    for (int i = 0; i < samples; ++i) {
        BsdfSample s;
        const bool counted =
            bsdf_sample(m, wo, front, LOBE_CLEAR, random4(84, uint(i), 0, 0), s) && here(s.wi);
        weight.add(counted ? double(s.weight.x) : 0);
        if (counted) {
            double pdf = 0;
            truth::rough_clear_eval_and_pdf(record_bytes(m), wo, s.wi, front, pdf);
            const double turned = is_solid(m) ? std::abs(double(m.ior) - 1) : 1;
            // Of the rounded direction, so near the horizon it may be another facet's.
            if (std::abs(double(s.wi.z)) > 0.02) {
                ASSERT_NEAR(s.pdf, pdf, (1e-3 + 1e-5 / (double(ggx_alpha(m)) * turned)) * pdf);
            }
            ASSERT_TRUE(is_finite3(s.weight));
            ++counts[cells.cell_of(s.wi)];
        }
    }
    const double inside = std::accumulate(density.begin(), density.end(), 0.0);
    const double counted = std::accumulate(counts.begin(), counts.end(), 0.0);
    EXPECT_NEAR(counted / samples, inside,
                5 * std::sqrt(inside * std::abs(1 - inside) / samples) + 4e-3);
    std::vector<double> expected;
    for (const double p : density) {
        expected.push_back(p * counted / inside);
    }
    if (counted > 1000) { // else too few for the cells
        EXPECT_LT(chi_square_deviations(counts, expected), unlikely);
    }
    const double albedo = std::accumulate(values.begin(), values.end(), 0.0);
    EXPECT_NEAR(weight.value(), albedo, 5 * weight.deviation() + 4e-3 * albedo);
}

TEST(RoughGlass, SamplesFollowTheirDensity) {
    for (const float roughness : {0.1f, 0.4f, 1.0f}) {
        for (const double angle : {0.0, 50.0, 80.0}) {
            expect_sampling_to_match(rough_glass(roughness, 1.5f, false), at_angle(angle, 77), true,
                                     true);
            for (const float ior : {1.2f, 1.5f}) {
                for (const bool passes : {false, true}) {
                    const MaterialRecord m = rough_glass(roughness, ior, true);
                    expect_sampling_to_match(m, at_angle(angle, 77), true, passes);
                    if (angle < 40 || !passes) { // else reflected totally, but for a few facets
                        expect_sampling_to_match(m, at_angle(angle, 77), false, passes);
                    }
                }
            }
        }
    }
}

TEST(RoughGlass, SinglePrecisionIsStable) {
    std::mt19937 bits(85);
    int beyond = 0, far = 0;
    for (int i = 0; i < 200'000; ++i) {
        MaterialRecord m = any_material(bits);
        m.transmission = std::max(m.transmission, 0.1f);
        const vec3 wo = any_upper(bits), wi = any_side(bits);
        const bool front = bits() % 2 == 0;
        float pdf = 0;
        double pdf_truth = 0;
        const vec3 f = rough_clear_eval_and_pdf(m, wo, wi, front, pdf);
        const glm::dvec3 f_truth =
            truth::rough_clear_eval_and_pdf(record_bytes(m), wo, wi, front, pdf_truth);
        const double alpha = std::max(double(ggx_alpha(m)), 1e-3);
        const double turned = is_solid(m) ? std::max(std::abs(double(m.ior) - 1), 1e-3) : 1;
        // Near the critical angle, rounding changes Fresnel's factor by its root.
        const double bound = 1e-2 + 1e-6 / (alpha * turned);
        double worst = std::abs(double(pdf) - pdf_truth) / (pdf_truth + 1e-6);
        for (int k = 0; k < 3; ++k) {
            worst = std::max(worst, std::abs(double(f[k]) - f_truth[k]) / (f_truth[k] + 1e-6));
        }
        far += worst > bound ? 1 : 0;
        beyond += worst > 2e-5 + 1e-6 / (alpha * turned) ? 1 : 0;
    }
    EXPECT_LT(beyond, 200); // one in a thousand
    EXPECT_LT(far, 10);
}

} // namespace
} // namespace argand
