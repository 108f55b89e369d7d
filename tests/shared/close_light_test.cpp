#include "mesh.hpp"
#include "oracle.hpp"
#include "shared/close_light.h"

#include <gtest/gtest.h>

namespace argand {
namespace {

using testing::any_direction;

/// Of directions that sample_close_cone() finds: the mean of 1 / density, over the solid angle of
/// the cone. It is 1 if the density is that of the samples, and nowhere 0.
double covered_share(const CloseCone& c, std::mt19937& bits) {
    constexpr int count = 200'000;
    std::uniform_real_distribution<float> number(0, LARGEST_BELOW_1);
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        const vec3 direction = sample_close_cone(c, {number(bits), number(bits)});
        EXPECT_NEAR(glm::length(direction), 1, 1e-5);
        const double pdf = close_cone_pdf(c, direction);
        sum += pdf > 0 ? 1 / pdf : 0; // a direction on the rim may round to one outside
    }
    return sum / count / cone_solid_angle(c.cone);
}

/// The integral of the density over the cone, by samples of even density.
double integral(const CloseCone& c, std::mt19937& bits) {
    constexpr int count = 400'000;
    std::uniform_real_distribution<float> number(0, LARGEST_BELOW_1);
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        // More of them near the axis, where the density is high.
        const double u = number(bits);
        const double below = c.cone.height * u * u * u;
        const vec3 direction = direction_in_cone(c.cone, static_cast<real>(below), number(bits));
        sum += close_cone_pdf(c, direction) * 3 * u * u;
    }
    return sum / count * cone_solid_angle(c.cone);
}

TEST(CloseCone, DensityIsThatOfItsSamples) {
    std::mt19937 bits(1);
    for (const float close : {0.0f, 0.003f, 0.1f}) {
        for (const float distance : {0.5f, 1.2f, 40.0f}) {
            SCOPED_TRACE(::testing::Message() << close << " at " << distance);
            const vec3 light = vec3(3, -2, 1);
            const CloseCone c =
                close_cone(vec4(light, close), 1, light + distance * any_direction(bits));
            ASSERT_GT(c.cone.height, 0);
            EXPECT_NEAR(covered_share(c, bits), 1, 0.02);
            EXPECT_NEAR(integral(c, bits), 1, 0.02);
        }
    }
}

// The light on a surface is in proportion to 1 / distance². So must the density be, down to the
// distance of the surfaces.
TEST(CloseCone, DensityFallsWithTheSquareOfTheDistanceToTheLight) {
    const CloseCone c = close_cone(vec4(0, 0, 0, 0.01f), 1, vec3(0, 0, 10));
    const auto passing_at = [&](float distance) {
        return close_cone_pdf(c, glm::normalize(vec3(distance, 0, -10)));
    };
    EXPECT_NEAR(passing_at(0.2f) / passing_at(0.8f), 16, 0.2);
    EXPECT_NEAR(passing_at(0.01f) / passing_at(0), 0.5, 0.01);
    EXPECT_EQ(passing_at(1.01f), 0);
}

TEST(CloseCone, NothingIsAimedFromTheLightOrAtSurfacesAsFarAsTheReach) {
    const vec3 light(1, 2, 3);
    EXPECT_EQ(close_cone(vec4(light, 0.1f), 1, light).cone.height, 0);
    EXPECT_EQ(close_cone(vec4(light, 0.0f), 1, light).cone.height, 0);
    EXPECT_EQ(close_cone(vec4(light, 0.1f), 1, light + vec3(0, 0.1f, 0)).cone.height, 0);
    EXPECT_EQ(close_cone(vec4(light, 1.0f), 1, vec3(9, 2, 3)).cone.height, 0);
}

TEST(CloseCone, ScaleDoesNotMatter) {
    std::mt19937 bits(2);
    const CloseCone here = close_cone(vec4(0, 0, 0, 0.01f), 1, vec3(1, 3, 2));
    for (const float scale : {1e-15f, 1e15f}) {
        const CloseCone c = close_cone(scale * vec4(0, 0, 0, 0.01f), scale, scale * vec3(1, 3, 2));
        const vec3 direction = sample_close_cone(here, {0.6f, 0.3f});
        EXPECT_NEAR(close_cone_pdf(c, direction) / close_cone_pdf(here, direction), 1, 1e-4);
    }
}

} // namespace
} // namespace argand
