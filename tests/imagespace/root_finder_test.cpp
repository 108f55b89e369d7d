// The root finder on surfaces of which the distance is known in every direction.
#include "shared/cube_map.h"
#include "shared/frame.h"
#include "shared/geometry_records.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace argand {
namespace {

struct Finder {
    std::function<float(vec3)> surface; ///< distance along a unit vector
    mutable int looks = 0;

    float map_distance(uint, vec3 direction) const {
        ++looks;
        return surface(direction);
    }
#include "shared/kernels/imagespace/root_finder.h"

    /// Where the published iteration ends: its surface point's distance along the ray.
    float iterated(vec3 origin, vec3 direction, uint steps) {
        const PlaneRay ray = plane_ray(origin, direction);
        const Look last = iterate(ray, 0, look(ray, 0, vec2(1, 0)), steps);
        return last.direction.x * last.distance - ray.start;
    }

    /// The same for the bracketed one, from a point that is seen to one far behind the surface.
    float refined(vec3 origin, vec3 direction, float far, uint steps) {
        const PlaneRay ray = plane_ray(origin, direction);
        Look seen = look(ray, 0, vec2(ray.start, ray.height));
        const Look hidden = look(ray, 0, vec2(ray.start + far, ray.height));
        const Look last = refine(ray, 0, seen, hidden, steps);
        return last.direction.x * last.distance - ray.start;
    }
};

/// A sphere of radius 1 around a point within it, seen from the origin.
std::function<float(vec3)> sphere(vec3 center) {
    return [=](vec3 d) {
        const float along = dot3(d, center);
        return along + std::sqrt(along * along - dot3(center, center) + 1);
    };
}

std::function<float(vec3)> plane(vec3 normal, float distance) {
    return [=](vec3 d) {
        const float cosine = dot3(normal, d);
        return cosine > 1e-6f ? distance / cosine : float(far_away);
    };
}

struct RandomRay {
    vec3 origin, direction;
};

RandomRay random_ray(std::mt19937& random, float extent) {
    std::uniform_real_distribution<float> within(-extent, extent);
    std::normal_distribution<float> normal;
    RandomRay ray;
    float size = 0;
    ray.origin = vec3(within(random), within(random), within(random));
    ray.direction = unit_and_length(vec3(normal(random), normal(random), normal(random)), size);
    return ray;
}

TEST(RootFinder, IsExactOnPlanesAfterTwoSteps) {
    std::mt19937 random(1);
    Finder finder{plane(vec3(0.6f, 0, 0.8f), 1)};
    int tried = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto [origin, direction] = random_ray(random, 0.4f);
        const float cosine = dot3(direction, vec3(0.6f, 0, 0.8f));
        const bool starts_before = dot3(origin, vec3(0.6f, 0, 0.8f)) > 0.1f;
        if (cosine < 0.3f || !starts_before) { // else the plane is not seen everywhere
            continue;
        }
        ++tried;
        const float truth = (1 - dot3(origin, vec3(0.6f, 0, 0.8f))) / cosine;
        EXPECT_NEAR(finder.iterated(origin, direction, 2), truth, 1e-4f * truth);
        EXPECT_NEAR(finder.refined(origin, direction, 2 * truth, 2), truth, 1e-4f * truth);
    }
    EXPECT_GT(tried, 200);
}

/// The error on a sphere after some steps that 95 % of random rays do not exceed. The published
/// iteration does not converge for all.
template <class Find> float usual_error(const Find& find) {
    std::mt19937 random(2);
    const vec3 center(0.2f, -0.1f, 0.3f);
    Finder finder{sphere(center)};
    std::vector<float> errors;
    for (int i = 0; i < 5000; ++i) {
        const auto [origin, direction] = random_ray(random, 0.3f);
        const vec3 to = center - origin;
        const float along = dot3(direction, to);
        const float truth = along + std::sqrt(along * along - dot3(to, to) + 1);
        errors.push_back(std::abs(find(finder, origin, direction) - truth));
    }
    const auto place = errors.begin() + 4750;
    std::nth_element(errors.begin(), place, errors.end());
    return *place;
}

TEST(RootFinder, ConvergesOnSpheres) {
    const auto published = [](uint steps) {
        return usual_error([=](Finder& f, vec3 o, vec3 d) { return f.iterated(o, d, steps); });
    };
    const auto bracketed = [](uint steps) {
        return usual_error([=](Finder& f, vec3 o, vec3 d) { return f.refined(o, d, 3, steps); });
    };
    EXPECT_LT(published(5), published(3) / 4);
    EXPECT_LT(published(5), 1e-5f);
    EXPECT_LT(bracketed(5), bracketed(3) / 4);
    EXPECT_LT(bracketed(8), 1e-4f);
    EXPECT_LT(bracketed(16), 1e-5f);
}

TEST(RootFinder, LooksOnceForEachStep) {
    Finder finder{sphere(vec3(0))};
    finder.refined(vec3(0.1f), vec3(1, 0, 0), 3, 5);
    EXPECT_EQ(finder.looks, 2 + 5);
}

TEST(RootFinder, EndsOnRaysOfAnyKind) {
    const std::vector<std::function<float(vec3)>> surfaces = {
        sphere(vec3(0)), plane(vec3(1, 0, 0), 0), plane(vec3(0, 1, 0), 1e20f),
        [](vec3) { return float(far_away); }, [](vec3) { return 0.0f; }};
    const std::vector<vec3> vectors = {
        vec3(0),      vec3(1, 0, 0),     vec3(-1, 0, 0),        vec3(0, 1, 0),
        vec3(1e-30f), vec3(1e18f, 0, 0), vec3(0.5f, 0.5f, 0.5f)};
    for (const auto& surface : surfaces) {
        for (const vec3& origin : vectors) {
            for (const vec3& direction : vectors) {
                Finder finder{surface};
                finder.iterated(origin, direction, 64);
                finder.refined(origin, direction, 2, 64);
                EXPECT_LE(finder.looks, 2 * 64 + 3);
            }
        }
    }
}

} // namespace
} // namespace argand
