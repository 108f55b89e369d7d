// How photons from outside are aimed: the density of make_aim_tree, and that flux follows it.
#include "world/aim_tree.hpp"

#include "methods/outside_aims.hpp"
#include "shared/aim.h"
#include "shared/lights.h"
#include "shared/random.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <vector>

namespace argand {
namespace {

using Samples = std::vector<AimSample>;

vec4 random_numbers(uint i, uint of) { return random4(77, i, 0, of); }

/// As the kernel photon_emit.
AimedNumbers numbers_in(const std::vector<AimNode>& tree, const vec4& u) {
    AimedNumbers a = begin_aim(u);
    std::size_t index = 0;
    while (tree[index].axis != aim_leaf) {
        index = tree[index].child + (descend_aim(tree[index], a) ? 1 : 0);
    }
    return a;
}

/// Samples in a box of the hypercube.
Samples samples_in(const glm::dvec4& low, double size, uint count) {
    Samples samples(count);
    for (uint i = 0; i < count; ++i) {
        samples[i] = {low + size * glm::dvec4(random_numbers(i, 9)), 1.0};
    }
    return samples;
}

Samples in_two_places() {
    Samples samples = samples_in({0.3, 0.6, 0.48, 0.2}, 0.05, 300);
    const Samples others = samples_in({0.8, 0.1, 0.5, 0.7}, 0.02, 100);
    samples.insert(samples.end(), others.begin(), others.end());
    return samples;
}

struct Sums {
    double value = 0, squares = 0;
    uint count = 0;

    void add(double x) {
        value += x;
        squares += x * x;
        ++count;
    }
    double mean() const { return value / count; }
    double deviation() const {
        return std::sqrt(std::max(squares / count - mean() * mean(), 0.0) / count);
    }
};

// Any function of the numbers has the same integral, and no density is too small.
TEST(AimTree, DensityIntegratesToOne) {
    const auto tree = make_aim_tree(in_two_places(), 0);
    ASSERT_TRUE(is_aim_tree(tree));
    EXPECT_GT(tree.size(), 10u);
    const std::vector<std::function<double(const vec4&)>> functions = {
        [](const vec4&) { return 1.0; }, [](const vec4& u) { return double(u.x) * u.y; },
        [](const vec4& u) { return std::cos(3.0 * u.z) * std::exp(double(u.w)); }};
    const std::vector<double> integrals = {1, 0.25, std::sin(3.0) / 3 * (std::numbers::e - 1)};
    for (std::size_t f = 0; f < functions.size(); ++f) {
        Sums sums;
        for (uint i = 0; i < 200'000; ++i) {
            const AimedNumbers a = numbers_in(tree, random_numbers(i, 0));
            const vec4 u = end_aim(a);
            ASSERT_GE(a.concentration, 0.249f);
            for (int axis = 0; axis < 4; ++axis) {
                ASSERT_GE(u[axis], 0.0f);
                ASSERT_LT(u[axis], 1.0f);
            }
            sums.add(functions[f](u) / a.concentration);
        }
        EXPECT_NEAR(sums.mean(), integrals[f], 5 * sums.deviation()) << f;
    }
}

TEST(AimTree, FollowsTheSamples) {
    const auto tree = make_aim_tree(in_two_places(), 0);
    uint first = 0;
    uint second = 0;
    constexpr uint count = 100'000;
    for (uint i = 0; i < count; ++i) {
        const vec4 u = end_aim(numbers_in(tree, random_numbers(i, 1)));
        first +=
            glm::all(glm::lessThan(glm::abs(u - vec4(0.325f, 0.625f, 0.505f, 0.225f)), vec4(0.05f)))
                ? 1
                : 0;
        second +=
            glm::all(glm::lessThan(glm::abs(u - vec4(0.81f, 0.11f, 0.51f, 0.71f)), vec4(0.05f)))
                ? 1
                : 0;
    }
    // Evenly spread, one in 10,000 would lie in each box.
    EXPECT_GT(first, 0.1 * count);
    EXPECT_GT(second, 0.02 * count);
    EXPECT_GT(first, 2 * second);
}

// A light of one direction is aimed across it only.
TEST(AimTree, LeavesAxesAsTheyAre) {
    const auto tree = make_aim_tree(in_two_places(), 2);
    for (const AimNode& node : tree) {
        EXPECT_GE(node.axis, 2u);
    }
}

TEST(AimTree, ExtremeSamples) {
    const AimSample one{.u = glm::dvec4(0.9999999), .weight = 3};
    const std::vector<Samples> all = {
        {},
        {one},
        Samples(1000, one),                                   // all in one point
        Samples(1000, {glm::dvec4(0), 1e-300}),               // in a corner, hardly any light
        Samples(1000, {glm::dvec4(0.5), 1e300}),              // across cuts
        Samples(1000, {glm::dvec4(0.5), 0.0}),                // no light
        Samples(1000, {glm::dvec4(0.25, 0.5, 0.75, 1), 1.0}), // on the hypercube's face
    };
    for (std::size_t s = 0; s < all.size(); ++s) {
        SCOPED_TRACE(s);
        const auto tree = make_aim_tree(all[s], 0);
        ASSERT_TRUE(is_aim_tree(tree));
        Sums volume;
        for (uint i = 0; i < 20'000; ++i) {
            const AimedNumbers a = numbers_in(tree, random_numbers(i, 2));
            ASSERT_TRUE(std::isfinite(a.concentration) && a.concentration >= 0.249f);
            volume.add(1.0 / double(a.concentration));
        }
        EXPECT_NEAR(volume.mean(), 1, 5 * volume.deviation() + 1e-5);
    }
}

TEST(AimTree, NodesThatAreNoTree) {
    const auto tree = make_aim_tree(in_two_places(), 0);
    const auto with = [&](auto change) {
        std::vector<AimNode> nodes = tree;
        change(nodes.front());
        return is_aim_tree(nodes);
    };
    EXPECT_TRUE(with([](AimNode&) {}));
    EXPECT_FALSE(with([](AimNode& node) { node.child = 0; }));
    EXPECT_FALSE(with([&](AimNode& node) { node.child = static_cast<uint>(tree.size()) - 1; }));
    EXPECT_FALSE(with([](AimNode& node) { node.axis = 5; }));
    EXPECT_FALSE(with([](AimNode& node) { node.share = 0; }));
    EXPECT_FALSE(with([](AimNode& node) { node.cut = 1; }));
    EXPECT_FALSE(with([](AimNode& node) { node.share = std::numeric_limits<float>::quiet_NaN(); }));
    EXPECT_FALSE(is_aim_tree({}));
}

const Sphere scene_sphere{vec3(1, 2, 3), 4};

/// A light from outside whose photons start around `middle`.
LightRecord light_from(uint kind, const vec3& middle) {
    const vec3 down = glm::normalize(vec3(0.3f, 0.2f, -1));
    LightRecord l{};
    l.kind = kind;
    l.r = l.g = l.b = 2;
    l.dx = down.x;
    l.dy = down.y;
    l.dz = down.z;
    l.x = middle.x;
    l.y = middle.y;
    l.z = middle.z;
    l.ex = scene_sphere.radius + glm::distance(middle, scene_sphere.center);
    l.triangle_and_sides = 1;
    return l;
}

bool emit_aimed(const LightRecord& l, const vec4& u, real concentration, EmittedPhoton& p) {
    return light_emit_from_disc(l, all_light_kinds, scene_sphere, concentration, u, vec4(0), p);
}

const std::vector<vec3> middles = {scene_sphere.center, vec3(1.5f, 1, 2), vec3(-2, 3, 5)};

// What learning takes for the numbers of a photon are those that emit it.
TEST(AimedLight, NumbersOfAPhotonAreItsOwn) {
    for (const uint kind : {light_sky, light_directional}) {
        for (const vec3& middle : middles) {
            const LightRecord l = light_from(kind, middle);
            for (uint i = 0; i < 2000; ++i) {
                const vec4 u = random_numbers(i, 3);
                EmittedPhoton p;
                emit_aimed(l, u, 1, p);
                const glm::dvec4 found = numbers_of_photon(
                    l, middle, l.ex, p.origin + p.direction * (3.0f * u.x), p.direction);
                for (int axis = kind == light_sky ? 0 : 2; axis < 4; ++axis) {
                    // Near the poles the turn is not known well.
                    const bool pole = u.y < 0.01f || u.y > 0.99f;
                    EXPECT_NEAR(found[axis], u[axis], pole ? 1e-3 : 1e-5) << axis << ", " << i;
                }
            }
        }
    }
}

/// Mean flux per area, either way, through the square of the plane z = 1 around (x, y).
Sums flux_on_square(const LightRecord& l, const std::vector<AimNode>& tree, float x, float y,
                    float half) {
    Sums flux;
    for (uint i = 0; i < 200'000; ++i) {
        const AimedNumbers a = numbers_in(tree, random_numbers(i, 4));
        EmittedPhoton p;
        const bool emitted = emit_aimed(l, end_aim(a), a.concentration, p);
        const float t = (1 - p.origin.z) / p.direction.z;
        const vec3 q = p.origin + p.direction * t;
        const bool hit = emitted && t > 0 && std::abs(q.x - x) < half && std::abs(q.y - y) < half;
        flux.add(hit ? p.flux.y / (4 * half * half) : 0);
    }
    return flux;
}

/// A tree learnt from rays of the light to a square of the plane z = 1 around (1.5, 2).
std::vector<AimNode> tree_for_square(const LightRecord& l, const vec3& middle, float half) {
    Samples samples;
    samples.reserve(1000);
    for (uint i = 0; i < 1000; ++i) {
        const vec4 u = random_numbers(i, 5);
        const vec3 point(1.5f + half * (2 * u.x - 1), 2 + half * (2 * u.y - 1), 1);
        const vec3 direction =
            l.kind == light_sky ? sample_sphere(vec2(u.z, u.w)) : vec3(l.dx, l.dy, l.dz);
        samples.push_back(
            {numbers_of_photon(l, middle, l.ex, point, direction), std::abs(direction.z)});
    }
    return make_aim_tree(samples, l.kind == light_sky ? 0 : 2);
}

// Aiming changes photons' density and flux, but not the irradiance: E cos θ of the sun, and π L on
// either side under the sky.
TEST(AimedLight, BringsTheSameIrradiance) {
    for (const uint kind : {light_sky, light_directional}) {
        for (const vec3& middle : middles) {
            const LightRecord l = light_from(kind, middle);
            const double expected = kind == light_sky ? 4 * std::numbers::pi : -2.0 * double(l.dz);
            const auto tree = tree_for_square(l, middle, 0.2f);
            const std::vector<AimNode> even(1, {aim_leaf, 0, 0, 0});
            // In the square, across its edge, beside it, and far from it.
            for (const float x : {1.5f, 1.7f, 1.9f, 3.5f}) {
                const Sums flux = flux_on_square(l, tree, x, 2, 0.1f);
                EXPECT_NEAR(flux.mean(), expected, 5 * flux.deviation())
                    << kind << ", " << middle.x << ", " << x;
            }
            EXPECT_LT(flux_on_square(l, tree, 1.5f, 2, 0.1f).deviation(),
                      0.5 * flux_on_square(l, even, 1.5f, 2, 0.1f).deviation())
                << kind << ", " << middle.x;
        }
    }
}

// A tree learnt elsewhere, as of a target behind the scene, changes no mean either.
TEST(AimedLight, AimedBesideTheScene) {
    for (const uint kind : {light_sky, light_directional}) {
        const vec3 middle(-2, 3, 5);
        const LightRecord l = light_from(kind, middle);
        const auto tree = make_aim_tree(samples_in({0.1, 0.1, 0.01, 0.01}, 0.02, 500), 0);
        Sums power;
        for (uint i = 0; i < 200'000; ++i) {
            const AimedNumbers a = numbers_in(tree, random_numbers(i, 6));
            EmittedPhoton p;
            power.add(emit_aimed(l, end_aim(a), a.concentration, p) ? p.flux.x : 0);
        }
        const double expected = light_power(l, all_light_kinds, scene_sphere.radius).x;
        EXPECT_NEAR(power.mean(), expected, 5 * power.deviation()) << kind;
    }
}

} // namespace
} // namespace argand
