// Splats of photons (Yao et al. 2010, section 6) against their formula in double precision.
#include "numbers.hpp"
#include "shared/footprint.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace argand {
namespace {

constexpr float scene_length = 3;
constexpr glm::vec2 sizes(0.2f, 0.05f);
constexpr glm::vec2 densities(0.25f, 16);

/// h = size / sqrt(p), p = cos(theta) / d², clamped.
double radius_of(double cosine, double distance, bool caustic) {
    const double d = distance / double(scene_length);
    const double p = std::clamp(cosine / (d * d), double(densities.x), double(densities.y));
    return double(caustic ? sizes.y : sizes.x) / std::sqrt(p);
}

Footprint splat(double cosine, double distance, bool caustic, vec3 normal) {
    const Frame frame = make_frame(normal);
    const double sine = std::sqrt(1 - cosine * cosine);
    const vec3 direction = frame.x * static_cast<float>(sine) - normal * static_cast<float>(cosine);
    return make_footprint(splat_differential(direction, static_cast<float>(distance), normal),
                          normal, caustic, splat_scale(sizes, scene_length, densities, 0.3f));
}

TEST(Splat, IsADiscOfThePapersRadius) {
    std::mt19937 bits(7);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 2000; ++i) {
        const vec3 normal = testing::rounded(
            glm::normalize(glm::dvec3(uniform(bits) - 0.5, uniform(bits), uniform(bits) - 0.5)));
        const double cosine = 0.001 + 0.998 * uniform(bits);
        const double distance = scene_length * std::exp2(8 * uniform(bits) - 6);
        for (const bool caustic : {false, true}) {
            const Footprint f = splat(cosine, distance, caustic, normal);
            const double expected = radius_of(cosine, distance, caustic);
            EXPECT_NEAR(glm::length(glm::dvec3(f.u)), expected, 1e-3 * expected);
            EXPECT_NEAR(glm::length(glm::dvec3(f.v)), expected, 1e-3 * expected);
            EXPECT_NEAR(glm::dot(glm::dvec3(f.u), glm::dvec3(f.v)), 0, 1e-5 * expected * expected);
            EXPECT_NEAR(glm::dot(glm::dvec3(f.u), glm::dvec3(normal)), 0, 1e-5 * expected);
            EXPECT_NEAR(glm::length(glm::dvec3(f.w)), 0.3 * expected, 1e-3 * expected);
        }
    }
}

TEST(Splat, StaysWithinItsBoundsAtTheExtremes) {
    const vec3 up(0, 1, 0);
    const auto size = [&](double cosine, double distance) {
        return double(glm::length(splat(cosine, distance, false, up).u));
    };
    const double least = double(sizes.x) / 4;
    const double most = double(sizes.x) / 0.5;
    EXPECT_NEAR(size(1, 0), least, 1e-6);
    EXPECT_NEAR(size(1, 1e-30), least, 1e-6);
    EXPECT_NEAR(size(0, 1), most, 1e-6);
    EXPECT_NEAR(size(0, 1e25), most, 1e-5);
    EXPECT_NEAR(size(1, 1e29), most, 1e-5);
}

} // namespace
} // namespace argand
