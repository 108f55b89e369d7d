// Thin films against the formulas of KHR_materials_iridescence, written anew in double precision
// and in nanometres.
#include "reciprocity.hpp"
#include "shared/random.h"

#include <array>
#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace argand::testing;

constexpr double pi = 3.14159265358979323846;

double schlick(double f0, double cosine) { return f0 + (1 - f0) * std::pow(1 - cosine, 5); }

/// Sensitivity of X, Y and Z, then as linear sRGB. path [nm], shift [rad].
glm::dvec3 sensitivity(double path, const glm::dvec3& shift) {
    const double phase = 2 * pi * path * 1e-9;
    const auto lobe = [&](double value, double position, double variance, double by) {
        return value * std::sqrt(2 * pi * variance) * std::cos(position * phase + by) *
               std::exp(-phase * phase * variance) / 1.0685e-7;
    };
    const double x = lobe(5.4856e-13, 1.6810e6, 4.3278e9, shift.x) +
                     lobe(9.7470e-14, 2.2399e6, 4.5282e9, shift.x);
    const double y = lobe(4.4201e-13, 1.7953e6, 9.3046e9, shift.y);
    const double z = lobe(5.2481e-13, 2.2084e6, 6.6121e9, shift.z);
    return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
            -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
            0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

glm::dvec3 film_by_the_extension(const glm::dvec3& f0, double index, double nanometres,
                                 double cosine) {
    const double inside = std::sqrt(1 - (1 - cosine * cosine) / (index * index));
    const double r12 = schlick(std::pow((index - 1) / (index + 1), 2), cosine);
    const double t121 = 1 - r12;
    glm::dvec3 r23(0), shift(0);
    for (int i = 0; i < 3; ++i) {
        const double root = std::sqrt(std::min(f0[i], 0.9999));
        const double base = (1 + root) / (1 - root);
        r23[i] = schlick(std::pow((base - index) / (base + index), 2), inside);
        shift[i] = pi + (base < index ? pi : 0);
    }
    const glm::dvec3 r123 = glm::clamp(r12 * r23, 1e-5, 0.9999);
    const glm::dvec3 rs = t121 * t121 * r23 / (1.0 - r123);
    glm::dvec3 sum = r12 + rs;
    glm::dvec3 c = rs - t121;
    for (int m = 1; m <= 2; ++m) {
        c *= glm::sqrt(r123);
        sum += c * 2.0 * sensitivity(m * 2 * index * nanometres * inside, double(m) * shift);
    }
    return glm::clamp(sum, 0.0, 1.0);
}

TEST(Iridescence, AgreesWithTheExtension) {
    std::mt19937 bits(41);
    for (int i = 0; i < 20'000; ++i) {
        const vec3 f0(to_unit_float(bits), i % 7 == 0 ? 1.0f : to_unit_float(bits),
                      i % 5 == 0 ? 0.04f : to_unit_float(bits));
        const float index = i % 6 == 0 ? 1.0f : 1 + 1.5f * to_unit_float(bits);
        const float micrometres = 1.5f * to_unit_float(bits);
        if (micrometres < 1e-4f) {
            continue;
        }
        const float cosine = any_upper(bits).z;
        const vec3 found = film_reflectance(f0, index, micrometres, cosine);
        const glm::dvec3 expected =
            film_by_the_extension(glm::dvec3(f0), index, 1000 * double(micrometres), cosine);
        for (int k = 0; k < 3; ++k) {
            ASSERT_NEAR(found[k], expected[k], 1e-3) << "case " << i << ", " << k;
        }
    }
}

// Without a film between them, air and surface reflect by Schlick's approximation: along the
// normal, as elsewhere the extension cuts its series too short for that.
TEST(Iridescence, FadesWithTheFilm) {
    for (const float cosine : {0.0f, 0.1f, 0.5f, 0.95f, 1.0f}) {
        const vec3 bare = fresnel_schlick(vec3(0.04f, 0.3f, 0.9f), 1, cosine);
        for (const float index : {1.0f, 1.5f}) {
            const vec3 none = film_reflectance(vec3(0.04f, 0.3f, 0.9f), index, 0, cosine);
            EXPECT_NEAR(glm::distance(none, bare), 0, cosine > 0.9f ? 0.02 : 0.4) << cosine;
        }
        for (const float thickness : {0.0f, 1e-6f, 0.4f, 100.0f}) {
            const vec3 f = film_reflectance(vec3(0, 0.5f, 1), 1e6f, thickness, cosine);
            EXPECT_TRUE(is_finite3(f));
            EXPECT_LE(max_component(f), 1.0f);
        }
    }
}

MaterialRecord any_film(std::mt19937& bits) {
    MaterialRecord m = any_material(bits);
    m.film = bits() % 2 == 0 ? 1 : to_unit_float(bits);
    m.film_ior = 1 + to_unit_float(bits);
    m.film_thickness = 0.1f + to_unit_float(bits);
    return m;
}

TEST(Iridescence, IsReciprocalAndInQueriesAndStable) { expect_reciprocal_and_stable(42, any_film); }

/// Share of light from wo that is scattered.
glm::dvec3 scattered(const MaterialRecord& m, vec3 wo, bool front) {
    glm::dvec3 sum(0);
    const int samples = 8000;
    for (int i = 0; i < samples; ++i) {
        BsdfSample s;
        if (bsdf_sample(m, wo, front, LOBES_ALL, random4(43, uint(i), 0, 0), s)) {
            sum += glm::dvec3(s.weight) / double(samples);
        }
    }
    return sum;
}

TEST(Furnace, FilmsGainNoLight) {
    std::mt19937 bits(44);
    for (int i = 0; i < 150; ++i) {
        MaterialRecord m = any_film(bits);
        m = with_color(m, vec3(1));
        m.specular_r = 1;
        const vec3 wo = at_angle(double(bits() % 90));
        const glm::dvec3 sum = scattered(m, wo, i % 2 == 0);
        for (int k = 0; k < 3; ++k) {
            EXPECT_LT(sum[k], 1.06) << "case " << i; // 0.04 of it noise
        }
    }
}

} // namespace
} // namespace argand
