#include "numbers.hpp"
#include "shared/frame.h"
#include "shared/random.h"
#include "statistics.hpp"

#include <gtest/gtest.h>
#include <random>

namespace argand {
namespace {

using testing::chi_square_deviations;
using testing::Mean;
using testing::unlikely;

vec3 unit_of(double x, double y, double z) {
    return testing::rounded(glm::normalize(glm::dvec3(x, y, z)));
}

vec3 any_unit(std::mt19937& bits) {
    std::normal_distribution<double> normal;
    return unit_of(normal(bits), normal(bits), normal(bits));
}

double dot_double(vec3 a, vec3 b) {
    return double(a.x) * b.x + double(a.y) * b.y + double(a.z) * b.z;
}

void expect_orthonormal(vec3 z) {
    const Frame f = make_frame(z);
    const double bound = 5e-7;
    EXPECT_EQ(f.z, z);
    EXPECT_NEAR(dot_double(f.x, f.x), 1, bound);
    EXPECT_NEAR(dot_double(f.y, f.y), 1, bound);
    EXPECT_NEAR(dot_double(f.x, f.y), 0, bound);
    EXPECT_NEAR(dot_double(f.x, f.z), 0, bound);
    EXPECT_NEAR(dot_double(f.y, f.z), 0, bound);
    const vec3 right_handed = cross3(f.x, f.y);
    EXPECT_NEAR(dot_double(right_handed, f.z), 1, bound);
}

TEST(Frame, IsOrthonormalAroundAnyVector) {
    std::mt19937 bits(1);
    for (int i = 0; i < 20'000; ++i) {
        expect_orthonormal(any_unit(bits));
        // Near the poles, where other constructions fail.
        const double tiny = std::exp2(-double(bits() % 40));
        expect_orthonormal(unit_of(tiny, -tiny, i % 2 == 0 ? 1 : -1));
    }
    for (const vec3 axis :
         {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(-1, 0, 0), vec3(0, -1, 0),
          vec3(0, 0, -1), vec3(0.0f, 0.0f, -0.0f) + vec3(1, 0, 0)}) {
        expect_orthonormal(axis);
    }
}

TEST(Frame, ToLocalInvertsToWorld) {
    std::mt19937 bits(2);
    for (int i = 0; i < 10'000; ++i) {
        const Frame f = make_frame(any_unit(bits));
        const vec3 v = any_unit(bits);
        const vec3 back = to_local(f, to_world(f, v));
        EXPECT_NEAR(back.x, v.x, 1e-6);
        EXPECT_NEAR(back.y, v.y, 1e-6);
        EXPECT_NEAR(back.z, v.z, 1e-6);
    }
}

/// Cells of equal probability: a coordinate (by its distribution function, in [0,1]) times an
/// angle.
class Histogram {
public:
    void add(double quantile, double x, double y) {
        const double turn = std::atan2(y, x) / 6.283185307179586 + 0.5;
        const auto row =
            std::min<std::size_t>(15, static_cast<std::size_t>(std::max(0.0, quantile) * 16));
        const auto column = std::min<std::size_t>(31, static_cast<std::size_t>(turn * 32));
        ++counts_[row * 32 + column];
    }
    double deviations() const { return chi_square_deviations(counts_); }

private:
    std::vector<double> counts_ = std::vector<double>(16 * 32);
};

TEST(Sampling, FollowsItsDensity) {
    Histogram disc;
    Histogram hemisphere;
    Histogram sphere;
    for (std::uint32_t i = 0; i < 200'000; ++i) {
        const vec4 u = random4(3, i, 0, 0);
        const vec2 d = sample_disc(vec2(u.x, u.y));
        ASSERT_LE(double(d.x) * d.x + double(d.y) * d.y, 1.0);
        disc.add(double(d.x) * d.x + double(d.y) * d.y, d.x, d.y);
        const vec3 h = sample_cosine_hemisphere(vec2(u.x, u.y));
        ASSERT_GT(h.z, 0.0f);
        ASSERT_NEAR(dot_double(h, h), 1, 1e-6);
        hemisphere.add(1 - double(h.z) * h.z, h.x, h.y); // the density integrates to sin²
        const vec3 s = sample_sphere(vec2(u.z, u.w));
        ASSERT_NEAR(dot_double(s, s), 1, 1e-6);
        sphere.add(0.5 + 0.5 * s.z, s.x, s.y);
    }
    EXPECT_LT(disc.deviations(), unlikely);
    EXPECT_LT(hemisphere.deviations(), unlikely);
    EXPECT_LT(sphere.deviations(), unlikely);
}

TEST(Sampling, DensitiesIntegrateToOne) {
    const int steps = 2000; // midpoints of cos θ
    double hemisphere = 0;
    for (int i = 0; i < steps; ++i) {
        hemisphere +=
            cosine_hemisphere_pdf((float(i) + 0.5f) / float(steps)) * 2 * double(PI) / steps;
    }
    EXPECT_NEAR(hemisphere, 1, 1e-5);
    EXPECT_EQ(cosine_hemisphere_pdf(-0.5f), 0.0f);
    EXPECT_NEAR(UNIFORM_SPHERE_PDF * 4 * double(PI), 1, 1e-6);
}

TEST(Sampling, CornersOfTheSquareGiveValidDirections) {
    const float last = 1 - 0x1p-24f;
    for (const float x : {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, last}) {
        for (const float y : {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, last}) {
            const vec3 h = sample_cosine_hemisphere(vec2(x, y));
            EXPECT_GT(h.z, 0.0f) << "x " << x << ", y " << y;
            EXPECT_NEAR(dot_double(h, h), 1, 1e-6);
            EXPECT_NEAR(dot_double(sample_sphere(vec2(x, y)), sample_sphere(vec2(x, y))), 1, 1e-6);
            const vec2 b = sample_triangle(vec2(x, y));
            EXPECT_GE(b.x, 0.0f);
            EXPECT_GE(b.y, 0.0f);
            EXPECT_LE(b.x + b.y, 1.0f);
        }
    }
}

TEST(Sampling, TrianglePointsAreUniform) {
    std::vector<double> counts(64);
    for (std::uint32_t i = 0; i < 100'000; ++i) {
        const vec4 u = random4(5, i, 0, 0);
        const vec2 b = sample_triangle(vec2(u.x, u.y));
        // The triangle divided into 8 × 8 small ones of equal area: find the strip, then the small
        // triangle in it.
        const auto row = std::min(7, static_cast<int>(b.x * 8));
        const double along = b.y * 8;
        const auto column = std::min(7 - row, static_cast<int>(along));
        const bool upper = (double(b.x) * 8 - row) + (along - column) > 1;
        ++counts[static_cast<std::size_t>(row * (16 - row)) + 2 * column + (upper ? 1 : 0)];
    }
    EXPECT_LT(chi_square_deviations(counts), unlikely);
}

TEST(PackedUnit, ErrorIsBounded) {
    std::mt19937 bits(4);
    double worst = 0;
    for (int i = 0; i < 500'000; ++i) {
        const vec3 v = any_unit(bits);
        const vec3 w = unpack_unit(pack_unit(v));
        EXPECT_NEAR(dot_double(w, w), 1, 1e-6);
        const vec3 c = cross3(v, w);
        worst = std::max(worst, std::sqrt(dot_double(c, c)));
    }
    EXPECT_LT(worst, 6.5e-5);
    EXPECT_GT(worst, 2e-5); // the bound is tight
}

TEST(PackedUnit, AxesAreExact) {
    for (const vec3 axis : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(-1, 0, 0),
                            vec3(0, -1, 0), vec3(0, 0, -1)}) {
        EXPECT_EQ(unpack_unit(pack_unit(axis)), axis);
    }
}

TEST(PackedUnit, EveryCodeUnpacksToAUnitVectorThatPacksToItsEqual) {
    std::mt19937 bits(5);
    for (int i = 0; i < 500'000; ++i) {
        std::uint32_t code = bits();
        code = i % 4 == 0 ? code & 0xffff0000u
                          : code; // the lowest coordinate, one step outside the square
        const vec3 v = unpack_unit(code);
        ASSERT_NEAR(dot_double(v, v), 1, 1e-6) << "code " << code;
        const vec3 again = unpack_unit(pack_unit(v));
        ASSERT_NEAR(dot_double(v - again, v - again), 0, 1e-8)
            << "code " << code; // on the seams two codes mean the same vector
    }
}

} // namespace
} // namespace argand
