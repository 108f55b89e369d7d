// Compares samplers with the densities that they claim: counts sampled directions in cells, whose
// probabilities are integrals of bsdf_pdf, and compares mean weights with integrals of bsdf_eval.
#include "materials.hpp"
#include "shared/random.h"
#include "statistics.hpp"

#include <gtest/gtest.h>
#include <numeric>

namespace argand {
namespace {

using namespace argand::testing;

constexpr double pi = 3.14159265358979323846;

/// Divides the hemisphere of wi into cells of the half vector h. Rows divide the share p of GGX
/// normals (of this roughness) that are closer to the surface's normal, so that they are fine where
/// the lobe is; columns divide the azimuth. Rows are equal in q = 1 - sqrt(1 - p), which bounds the
/// density of grazing reflections.
class Cells {
public:
    Cells(vec3 wo, double alpha) : wo_(wo), alpha_(alpha) {}

    std::size_t count() const { return rows * columns; }

    std::size_t cell_of(vec3 wi) const {
        const glm::dvec3 h = glm::normalize(wo_ + glm::dvec3(wi));
        const double tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z);
        const double q = 1 - std::sqrt(alpha_ * alpha_ / (alpha_ * alpha_ + tan2));
        const double turn = std::atan2(h.y, h.x) / (2 * pi) + 0.5;
        const auto row = std::min(rows - 1, static_cast<std::size_t>(q * rows));
        const auto column = std::min(columns - 1, static_cast<std::size_t>(turn * columns));
        return row * columns + column;
    }

    /// Integrates f(wi) over each cell by the midpoint rule.
    template <class F> std::vector<double> integrate(const F& f) const {
        std::vector<double> integrals(count());
        const int steps = 16;
        for (std::size_t cell = 0; cell < count(); ++cell) {
            for (int i = 0; i < steps * steps; ++i) {
                // The square gathers points at the far end of the row, which in the last one takes
                // in half the hemisphere.
                const double root = (i / steps + 0.5) / steps;
                const double rest = 1 - (double(cell / columns) + 1 - root * root) / rows; // 1 - q
                const double turn = (double(cell % columns) + (i % steps + 0.5) / steps) / columns;
                const double tan2 = alpha_ * alpha_ * (1 / (rest * rest) - 1);
                const double z = 1 / std::sqrt(1 + tan2);
                const double around = 2 * pi * (turn - 0.5);
                const glm::dvec3 h(std::sqrt(tan2) * z * std::cos(around),
                                   std::sqrt(tan2) * z * std::sin(around), z);
                const double cosine = glm::dot(wo_, h);
                const glm::dvec3 wi = 2 * cosine * h - wo_;
                if (wi.z <= 0 || cosine <= 0) {
                    continue;
                }
                // d tan² / dq, solid angle of h by tan² and azimuth, solid angle of wi over that of
                // h
                const double measure = 2 * root * 2 * alpha_ * alpha_ / (rest * rest * rest) * z *
                                       z * z / 2 * 4 * cosine;
                integrals[cell] +=
                    f(rounded(wi)) * measure * 2 * pi / double(count() * steps * steps);
            }
        }
        return integrals;
    }

private:
    static constexpr std::size_t rows = 16, columns = 32;
    glm::dvec3 wo_;
    double alpha_;
};

void expect_sampling_to_match(const MaterialRecord& m, vec3 wo, uint lobes, int samples) {
    SCOPED_TRACE(::testing::Message()
                 << "metallic " << m.metallic << " roughness " << m.roughness << " transmission "
                 << m.transmission << " wo.z " << wo.z << " lobes " << lobes);
    const uint rough = lobes & (LOBE_DIFFUSE | LOBE_GLOSSY);
    const bool glossy_only = (bsdf_lobes(m) & rough) == LOBE_GLOSSY;
    const Cells cells(wo, glossy_only ? double(ggx_alpha(m)) : std::max(0.3, double(ggx_alpha(m))));
    const std::vector<double> density =
        cells.integrate([&](vec3 wi) { return double(bsdf_pdf(m, wo, wi, lobes)); });
    const std::vector<double> reflected =
        cells.integrate([&](vec3 wi) { return double(bsdf_eval(m, wo, wi, lobes).x) * wi.z; });

    std::vector<double> counts(cells.count());
    Mean weight;
    double delta_probability = lobe_probabilities(m, wo, lobes).z;
    for (int i = 0; i < samples; ++i) {
        BsdfSample s;
        const bool scattered = bsdf_sample(m, wo, true, lobes, random4(11, uint(i), 0, 0), s);
        const bool counts_here = scattered && (s.lobe & rough) != 0;
        weight.add(counts_here ? double(s.weight.x) : 0);
        if (counts_here) {
            ASSERT_GT(s.wi.z, 0.0f);
            ASSERT_GT(s.pdf, 0.0f);
            ASSERT_TRUE(is_finite3(s.weight));
            ASSERT_NEAR(s.pdf, bsdf_pdf(m, wo, s.wi, lobes), 1e-5 * s.pdf);
            ++counts[cells.cell_of(s.wi)];
        }
    }
    // Samples that are neither counted nor from a delta lobe were reflected into the surface.
    const double inside = std::accumulate(density.begin(), density.end(), 0.0);
    EXPECT_LT(inside, 1.001 - delta_probability);
    const double counted = std::accumulate(counts.begin(), counts.end(), 0.0);
    EXPECT_NEAR(counted / samples, inside,
                5 * std::sqrt(inside * std::abs(1 - inside) / samples) + 3e-3);
    std::vector<double> expected;
    for (const double p : density) {
        expected.push_back(p * counted / inside);
    }
    EXPECT_LT(chi_square_deviations(counts, expected), unlikely);
    const double albedo = std::accumulate(reflected.begin(), reflected.end(), 0.0);
    EXPECT_NEAR(weight.value(), albedo, 5 * weight.deviation() + 2e-3 * albedo);
}

TEST(BsdfSampling, MetalFollowsItsDensity) {
    for (const float roughness : {0.033f, 0.1f, 0.3f, 0.6f, 1.0f}) {
        for (const double angle : {0.0, 45.0, 70.0, 85.0, 89.5}) {
            expect_sampling_to_match(metal(vec3(0.9f), roughness), at_angle(angle, 77), LOBES_ALL,
                                     40'000);
        }
    }
}

TEST(BsdfSampling, DielectricFollowsItsDensity) {
    for (const float roughness : {0.5f, 1.0f}) {
        for (const double angle : {0.0, 45.0, 80.0}) {
            for (const uint lobes : {LOBES_ALL, LOBE_DIFFUSE, LOBE_GLOSSY}) {
                expect_sampling_to_match(glossy_dielectric(roughness), at_angle(angle), lobes,
                                         40'000);
            }
        }
    }
}

// All four lobes at once: the delta lobes reduce the probability of the others.
TEST(BsdfSampling, MixedMaterialsFollowTheirDensity) {
    for (const float thickness : {0.0f, 1.0f}) {
        MaterialRecord m = glossy_dielectric(0.6f);
        m.metallic = 0.3f;
        m.transmission = 0.6f;
        m.thickness = thickness;
        for (const double angle : {10.0, 60.0}) {
            expect_sampling_to_match(m, at_angle(angle), LOBES_ALL, 60'000);
            expect_sampling_to_match(m, at_angle(angle), LOBE_DIFFUSE | LOBE_TRANSMIT, 60'000);
        }
    }
    expect_sampling_to_match(glossy_dielectric(0.0f), at_angle(40), LOBES_ALL, 60'000);
    expect_sampling_to_match(with_alpha(glossy_dielectric(0.6f), 0.4f), at_angle(40), LOBES_ALL,
                             60'000);
}

/// Mean weight of each lobe's samples, indexed by the lobe's bit.
std::array<Mean, 4> mean_weights(const MaterialRecord& m, vec3 wo, bool front, uint lobes,
                                 int samples) {
    std::array<Mean, 4> means;
    for (int i = 0; i < samples; ++i) {
        BsdfSample s;
        const bool scattered = bsdf_sample(m, wo, front, lobes, random4(12, uint(i), 0, 0), s);
        for (uint lobe = 0; lobe < 4; ++lobe) {
            means[lobe].add(scattered && s.lobe == (1u << lobe) ? double(s.weight.y) : 0);
        }
    }
    return means;
}

// The mean weights of delta lobes are their albedos, whichever other lobes share the samples.
TEST(BsdfSampling, SmoothLobesKeepTheirAlbedo) {
    std::mt19937 bits(1);
    for (int i = 0; i < 300; ++i) {
        MaterialRecord m = any_material(bits);
        m.roughness = i % 2 == 0 ? 0 : m.roughness;
        const vec3 wo = any_upper(bits);
        const bool front = i % 3 != 0;
        const auto means = mean_weights(m, wo, front, LOBES_ALL, 4000);
        EXPECT_NEAR(means[2].value(), bsdf_albedo(m, wo, front, LOBE_MIRROR).y,
                    5 * means[2].deviation() + 2e-3)
            << "case " << i;
        EXPECT_NEAR(means[3].value(), bsdf_albedo(m, wo, front, LOBE_TRANSMIT).y,
                    5 * means[3].deviation() + 2e-3)
            << "case " << i;
    }
}

// Splitting the lobes into two masks changes no lobe.
TEST(BsdfSampling, MasksPartitionTheLobes) {
    MaterialRecord m = glossy_dielectric(0.4f);
    m.metallic = 0.2f;
    m.transmission = 0.5f;
    const vec3 wo = at_angle(50);
    const auto all = mean_weights(m, wo, true, LOBES_ALL, 100'000);
    const double sum = all[0].value() + all[1].value();
    const auto rough = mean_weights(m, wo, true, LOBE_DIFFUSE | LOBE_GLOSSY, 100'000);
    const auto smooth = mean_weights(m, wo, true, LOBES_DELTA, 100'000);
    const auto diffuse = mean_weights(m, wo, true, LOBE_DIFFUSE, 100'000);
    const auto glossy = mean_weights(m, wo, true, LOBE_GLOSSY, 100'000);
    EXPECT_NEAR(rough[0].value() + rough[1].value(), sum, 0.01);
    EXPECT_NEAR(diffuse[0].value() + glossy[1].value(), sum, 0.01);
    EXPECT_NEAR(smooth[2].value(), all[2].value(), 0.01);
    EXPECT_NEAR(smooth[3].value(), all[3].value(), 0.01);
    EXPECT_EQ(smooth[0].value() + smooth[1].value(), 0.0);
}

TEST(Furnace, WhiteLambertianMirrorAndGlassReturnAllLight) {
    for (const double angle : {0.0, 30.0, 60.0, 89.0, 89.99}) {
        for (const bool front : {true, false}) {
            for (const MaterialRecord& m :
                 {lambertian(vec3(1)), metal(vec3(1), 0), glass(1.5f, 0), glass(1.5f, 1),
                  glass(2.4f, 1), glass(1.0f, 1), with_alpha(lambertian(vec3(1)), 0.3f),
                  with_alpha(glass(1.5f, 1), 0.6f)}) {
                for (int i = 0; i < 500; ++i) {
                    BsdfSample s;
                    ASSERT_TRUE(bsdf_sample(m, at_angle(angle), front, LOBES_ALL,
                                            random4(13, uint(i), 0, 0), s));
                    ASSERT_NEAR(s.weight.x, m.coverage, 1e-6); // each sample, not only their mean
                }
            }
        }
    }
}

// A layer that reflects everything lets nothing through to the diffuse lobe.
TEST(Furnace, NothingPassesALayerThatReflectsEverything) {
    MaterialRecord m = white_dielectric();
    m.ior = 0;
    EXPECT_EQ(bsdf_eval(m, at_angle(20), at_angle(50), LOBE_DIFFUSE), vec3(0));
}

} // namespace
} // namespace argand
