// Animations of nodes: values between keys against closed formulas, and posed scenes.
#include "animated.hpp"
#include "scene/key_frames.hpp"
#include "scene/pose.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace argand {
namespace {

using namespace testing_gltf;
using ::testing::HasSubstr;

constexpr double quarter = std::numbers::pi / 2;

TEST(KeyFrames, OneKeyIsConstant) {
    for (const Interpolation how : {Interpolation::step, Interpolation::linear}) {
        const KeyFrames keys{.times = {3}, .values = {7, 8}, .width = 2, .interpolation = how};
        for (const double time : {-1e9, 0.0, 3.0, 1e9}) {
            EXPECT_EQ(value_at(keys, time), (std::vector<double>{7, 8}));
        }
    }
    const KeyFrames spline{
        .times = {3}, .values = {1, 7, 1}, .interpolation = Interpolation::cubic_spline};
    EXPECT_EQ(value_at(spline, 4)[0], 7);
}

TEST(KeyFrames, StepsAndLinesGoThroughTheirKeys) {
    KeyFrames keys{
        .times = {1, 2, 4}, .values = {10, 20, 60}, .interpolation = Interpolation::step};
    EXPECT_EQ(value_at(keys, 0.5)[0], 10);
    EXPECT_EQ(value_at(keys, 1.999)[0], 10);
    EXPECT_EQ(value_at(keys, 2)[0], 20);
    EXPECT_EQ(value_at(keys, 9)[0], 60);
    keys.interpolation = Interpolation::linear;
    EXPECT_EQ(value_at(keys, 0.5)[0], 10);
    EXPECT_DOUBLE_EQ(value_at(keys, 1.25)[0], 12.5);
    EXPECT_EQ(value_at(keys, 2)[0], 20);
    EXPECT_DOUBLE_EQ(value_at(keys, 3.5)[0], 50);
    EXPECT_EQ(value_at(keys, 4)[0], 60);
}

TEST(KeyFrames, SplinesReproduceCubicPolynomials) {
    const auto f = [](double t) { return 2 * t * t * t - 3 * t * t + 5 * t - 1; };
    const auto slope = [](double t) { return 6 * t * t - 6 * t + 5; };
    KeyFrames keys{.times = {-1, 0.5, 4}, .interpolation = Interpolation::cubic_spline};
    for (const double t : keys.times) {
        // The tangents before the first key and after the last one do not count.
        keys.values.insert(keys.values.end(),
                           {t == -1 ? 99 : slope(t), f(t), t == 4 ? 99 : slope(t)});
    }
    for (double t = -1; t <= 4; t += 0.125) {
        EXPECT_NEAR(value_at(keys, t)[0], f(t), 1e-12 * (1 + std::abs(f(t)))) << t;
    }
}

TEST(KeyFrames, RotationsTurnEvenlyTheShorterWay) {
    // From 0 to 90 degrees about z; the second key is the same rotation with the other sign, and
    // not of unit length.
    const double s = std::sin(quarter / 2);
    const double c = std::cos(quarter / 2);
    const KeyFrames keys{.times = {0, 2}, .values = {0, 0, 0, 1, 0, 0, -3 * s, -3 * c}, .width = 4};
    for (double t = 0; t <= 2; t += 0.25) {
        const glm::dvec3 turned = rotation_at(keys, t) * glm::dvec3(1, 0, 0);
        EXPECT_NEAR(turned.x, std::cos(quarter * t / 2), 1e-14) << t;
        EXPECT_NEAR(turned.y, std::sin(quarter * t / 2), 1e-14) << t;
    }
    KeyFrames spline{.times = {0},
                     .values = {0, 0, 0, 0, 0, 0, 5, 5, 0, 0, 0, 0},
                     .width = 4,
                     .interpolation = Interpolation::cubic_spline};
    EXPECT_NEAR(glm::length(rotation_at(spline, 0)), 1, 1e-15);
}

TEST(KeyFrames, SplinesTellIncomingFromOutgoingTangents) {
    // A corner at 1 s: it arrives with slope 0 and leaves with slope 8.
    const KeyFrames keys{.times = {0, 1, 2},
                         .values = {0, 0, 0, 0, 1, 8, 0, 1, 0},
                         .interpolation = Interpolation::cubic_spline};
    EXPECT_DOUBLE_EQ(value_at(keys, 0.5)[0], 0.5);
    EXPECT_DOUBLE_EQ(value_at(keys, 1.5)[0], 2); // 1 + 8/8
}

TEST(KeyFrames, SplinesOfRotationsAreNormalised) {
    const KeyFrames keys{.times = {0, 1},
                         .values = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0,  //
                                    0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}, // half a turn about z
                         .width = 4,
                         .interpolation = Interpolation::cubic_spline};
    const glm::dquat half = rotation_at(keys, 0.5);
    EXPECT_NEAR(half.z, std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(half.w, std::sqrt(0.5), 1e-15);
}

Animated moving_triangle() {
    Animated file;
    const int node = file.builder.add_triangles(right_triangle(), {{"translation", {9, 9, 9}}});
    file.animate(node, "translation", {1, 3}, {{0, 0, 0}, {4, 0, 2}});
    return file;
}

TEST(Animation, MovesNodesAtATime) {
    const Animated file = moving_triangle();
    const auto corner = [&](std::optional<double> seconds) {
        return corners_of(file.load(seconds), 0)[0];
    };
    EXPECT_EQ(corner({}), glm::vec3(9, 9, 9)); // at rest
    EXPECT_EQ(corner(0), glm::vec3(0, 0, 0));
    EXPECT_EQ(corner(1.5), glm::vec3(1, 0, 0.5f));
    EXPECT_EQ(corner(100), glm::vec3(4, 0, 2));
}

TEST(Animation, MovesChildrenLightsAndCameras) {
    Animated file = moving_triangle();
    file.builder.root["extensionsUsed"] = {"KHR_lights_punctual"};
    file.builder.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    file.builder.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    json& nodes = file.builder.root["nodes"];
    nodes.push_back({{"translation", {0, 1, 0}},
                     {"camera", 0},
                     {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    nodes[0]["children"] = {1};
    const Scene scene = file.load(2.0);
    EXPECT_EQ(scene.lights[0].position, glm::vec3(2, 1, 1));
    EXPECT_EQ(scene.cameras[0].position, glm::vec3(2, 1, 1));
}

TEST(Animation, ACameraThatIsAddedStandsStill) {
    const Animated file = moving_triangle();
    EXPECT_EQ(file.load(3.0).cameras[0].position, file.load({}).cameras[0].position);
}

TEST(Animation, ThatStartsFromNothingCanBeSeen) {
    Animated file;
    const int node = file.builder.add_triangles(right_triangle(), {{"scale", {0, 0, 0}}});
    file.animate(node, "scale", {0, 1}, {{0, 0, 0}, {1, 1, 1}});
    EXPECT_EQ(file.load(1.0).triangles.size(), 1u);
    EXPECT_EQ(file.load({}).triangles.size(), 1u);
    EXPECT_EQ(file.load({}).cameras[0].position, file.load(0.5).cameras[0].position);
}

TEST(Animation, ReadsNormalisedIntegersAndSteps) {
    Animated file = moving_triangle();
    json& animation = file.builder.root["animations"][0];
    const int bytes = file.builder.add_accessor(
        file.builder.add_view(std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, -128, 0}), byte_type,
        "VEC4", 2);
    file.builder.root["accessors"][static_cast<std::size_t>(bytes)]["normalized"] = true;
    animation["samplers"][0]["output"] = bytes;
    animation["samplers"][0]["interpolation"] = "STEP";
    animation["channels"][0]["target"]["path"] = "rotation";
    for (const double time : {0.0, 2.0, 9.0}) { // half a turn about z, either way
        expect_near(corners_of(file.load(time), 0)[1], {8, 9, 9}, 1e-6);
    }
    file.builder.root["accessors"][static_cast<std::size_t>(bytes)].erase("normalized");
    EXPECT_THAT(file.builder.problem(), HasSubstr("neither floating-point nor normalised"));
}

TEST(Animation, TurnsTrianglesWhereANodeMirrors) {
    Animated file;
    const int node = file.builder.add_triangles(right_triangle());
    file.animate(node, "scale", {0, 2}, {{1, 1, 1}, {-1, 1, 1}});
    for (const double time : {0.0, 0.5, 1.5, 2.0, 0.5}) {
        EXPECT_GT(winding_normal(file.load(time), 0).z, 0) << time;
    }
    // Back and forth in one scene.
    Scene scene = file.load({});
    for (const double time : {2.0, 1.5, 0.0, 1.0, 0.5, 2.0}) {
        move_to(time, scene);
        EXPECT_EQ(winding_normal(scene, 0).z > 0, time != 1) << time;
    }
}

/// A triangle and a directional light, both of which a node turns over.
Animated turning_light() {
    Animated file = moving_triangle();
    file.animate(0, "scale", {0, 2}, {{1, 2, 3}, {-3, -2, -1}});
    file.builder.root["extensionsUsed"] = {"KHR_lights_punctual"};
    file.builder.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 5}}};
    file.builder.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    return file;
}

TEST(Animation, AMomentDoesNotDependOnThoseBefore) {
    Animated file = turning_light();
    Scene scene = file.load({});
    for (const double time : {3.0, 0.25, 1.5, 0.0}) { // at 1.5 s the light has no direction
        move_to(time, scene);
        const Scene fresh = file.load(time);
        EXPECT_EQ(scene.positions, fresh.positions);
        EXPECT_EQ(scene.triangles, fresh.triangles);
        EXPECT_EQ(scene.lights[0].direction, fresh.lights[0].direction);
        EXPECT_EQ(scene.lights[0].intensity, fresh.lights[0].intensity);
        EXPECT_EQ(scene.lights[0].intensity.r > 0, time != 1.5);
    }
}

TEST(Animation, WithoutVerticesMovesAllElse) {
    Animated file = turning_light();
    Scene scene = file.load({});
    const std::vector<glm::vec3> positions = scene.positions;
    for (const double time : {3.0, 0.25, 1.5, 0.0}) {
        move_without_vertices(time, scene);
        const Scene moved = file.load(time);
        EXPECT_EQ(scene.positions, positions);
        EXPECT_EQ(scene.triangles, moved.triangles);
        EXPECT_EQ(scene.lights, moved.lights);
        EXPECT_EQ(scene.seconds, time);
    }
}

TEST(Animation, WhatRestsIsNotKeptForMotion) {
    Animated file;
    file.builder.add_triangles(right_triangle());
    EXPECT_TRUE(file.load({}).motion.nodes.empty());
    const int still = file.builder.add_triangles(right_triangle());
    const int moving = file.builder.add_triangles(right_triangle());
    file.animate(moving, "translation", {0, 1}, {{0, 0, 0}, {1, 1, 1}});
    const Scene scene = file.load({});
    ASSERT_EQ(scene.motion.meshes.size(), 1u);
    EXPECT_EQ(scene.motion.meshes[0].node, static_cast<std::uint32_t>(moving));
    EXPECT_EQ(scene.motion.meshes[0].first_triangle, static_cast<std::size_t>(still) + 1);
}

TEST(Animation, TheFirstOneThatMovesAPropertyCounts) {
    Animated file = moving_triangle();
    file.animate(0, "translation", {0}, {{7, 7, 7}});
    file.animate(0, "scale", {0}, {{2, 2, 2}});
    const Scene scene = file.load(1.0);
    EXPECT_EQ(corners_of(scene, 0)[1], glm::vec3(2, 0, 0));
    EXPECT_EQ(scene.animations.size(), 3u);
    EXPECT_EQ(scene.animations[0].seconds, 3);
    EXPECT_EQ(scene.animations[0].moves, std::vector<std::string>{"translation of node 0"});
    EXPECT_THAT(scene.notes, ::testing::Contains(HasSubstr("several animations move")));
}

TEST(Animation, AStillSceneIsTheSameAtAnyTime) {
    Animated file;
    file.builder.add_triangles(right_triangle());
    EXPECT_EQ(file.load(5.0).positions, file.load({}).positions);
    EXPECT_THAT(file.load(5.0).notes, ::testing::Contains(HasSubstr("there is no animation")));
}

TEST(Animation, MalformedOnesAreErrors) {
    const auto problem = [](const auto& change) {
        Animated file = moving_triangle();
        change(file);
        return file.builder.problem();
    };
    const auto times = [&](const std::vector<float>& keys) {
        return problem([&](Animated& file) {
            file.builder.root["animations"].clear();
            file.animate(0, "scale", keys, std::vector<glm::vec3>(keys.size(), glm::vec3(1)));
        });
    };
    EXPECT_EQ(times({0, 1}), "");
    EXPECT_THAT(times({1, 1}), HasSubstr("the times of sampler 0 of animation 0 \"scale\" do not"));
    EXPECT_THAT(times({2, 1}), HasSubstr("do not rise: key 1 is at 1 s"));
    EXPECT_THAT(times({0, std::numeric_limits<float>::quiet_NaN()}), HasSubstr("do not rise"));
    const auto with = [&](const char* pointer, const json& value) {
        return problem([&](Animated& file) {
            file.builder.root["animations"][0][json::json_pointer(pointer)] = value;
        });
    };
    EXPECT_THAT(with("/channels/0/target/node", 5),
                HasSubstr("moves node 5, which does not exist"));
    EXPECT_THAT(with("/channels/0/target/path", "colour"), HasSubstr("moves \"colour\""));
    EXPECT_THAT(with("/channels/0/sampler", 3), HasSubstr("sampler 3, which does not exist"));
    EXPECT_THAT(with("/samplers/0/interpolation", "WAVY"), HasSubstr("interpolation \"WAVY\""));
    EXPECT_THAT(with("/samplers/0/interpolation", "CUBICSPLINE"), HasSubstr("need 6 of 3"));
    EXPECT_THAT(with("/samplers/0/input", 77), HasSubstr("accessor 77, which does not exist"));
    EXPECT_THAT(problem([](Animated& file) {
                    file.animate(0, "scale", {0}, {{1, std::nanf(""), 1}});
                }),
                HasSubstr("value 0 of sampler 0 of animation 1 \"scale\" is not finite"));
    EXPECT_THAT(problem([](Animated& file) {
                    json& animation = file.builder.root["animations"][0];
                    animation["samplers"][0]["output"] =
                        file.add_floats({0, 0, 0, 1, 0, 0, 0, 0}, "VEC4", 2);
                    animation["channels"][0]["target"]["path"] = "rotation";
                }),
                HasSubstr("at 3 s is not a unit quaternion"));
    EXPECT_THAT(problem([](Animated& file) {
                    file.builder.root["nodes"][0] = {
                        {"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
                }),
                HasSubstr("whose transform is a matrix"));
}

} // namespace
} // namespace argand
