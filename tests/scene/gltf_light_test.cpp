#include "gltf_builder.hpp"
#include "scene/studio.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

namespace argand {
namespace {

using namespace testing_gltf;

/// The triangle, and a node with this light and this transform.
GltfBuilder with_light(const json& light, json node = json::object()) {
    GltfBuilder builder = one_triangle();
    builder.root["extensionsUsed"] = {"KHR_lights_punctual"};
    builder.root["extensions"]["KHR_lights_punctual"]["lights"] = nlohmann::json::array({light});
    node["extensions"]["KHR_lights_punctual"]["light"] = 0;
    builder.add_node(node);
    return builder;
}

TEST(GltfLight, ReadsPointLights) {
    const Scene scene =
        with_light({{"type", "point"}, {"name", "bulb"}, {"color", {1, 0.5, 0}}, {"intensity", 40}},
                   {{"translation", {1, 2, 3}}, {"scale", {5, 5, 5}}})
            .load();
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].name, "bulb");
    EXPECT_EQ(scene.lights[0].kind, LightKind::point);
    EXPECT_EQ(scene.lights[0].position, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(40, 20, 0)); // the node's scale does not matter
    EXPECT_FALSE(scene.environment);
}

TEST(GltfLight, HasTheDefaultsOfTheExtension) {
    const Light light =
        with_light({{"type", "spot"}, {"spot", json::object()}}, {{"name", "carrier"}})
            .load()
            .lights.at(0);
    EXPECT_EQ(light.intensity, glm::vec3(1));
    EXPECT_EQ(light.inner_cone_angle, 0);
    EXPECT_FLOAT_EQ(light.outer_cone_angle, float(std::numbers::pi / 4));
    EXPECT_EQ(light.name, "carrier");
    EXPECT_EQ(light.direction, glm::vec3(0, 0, -1));
}

TEST(GltfLight, TurnsDirectionsWithTheNode) {
    const double half_root = std::sqrt(0.5);
    // A rotation by 90 degrees about x takes −z to +y.
    const Light light =
        with_light({{"type", "directional"}, {"intensity", 3}},
                   {{"rotation", {half_root, 0, 0, half_root}}, {"scale", {1, 2, 0.1}}})
            .load()
            .lights.at(0);
    EXPECT_EQ(light.kind, LightKind::directional);
    expect_near(light.direction, {0, 1, 0});
    EXPECT_EQ(light.intensity, glm::vec3(3));
}

TEST(GltfLight, ClampsConesToTheirRange) {
    const auto cone = [](double inner, double outer) {
        return with_light({{"type", "spot"},
                           {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}})
            .load();
    };
    EXPECT_FLOAT_EQ(cone(0.25, 0.5).lights[0].inner_cone_angle, 0.25f);
    EXPECT_FLOAT_EQ(cone(0.25, 0.5).lights[0].outer_cone_angle, 0.5f);
    EXPECT_EQ(cone(0.5, 0.5).notes, cone(0.25, 0.5).notes); // a sharp edge is allowed
    EXPECT_FLOAT_EQ(cone(0.75, 0.5).lights[0].inner_cone_angle, 0.5f);
    EXPECT_TRUE(has_note(cone(0.75, 0.5), "cone angles out of range"));
    EXPECT_FLOAT_EQ(cone(0, 3).lights[0].outer_cone_angle, float(std::numbers::pi / 2));
    EXPECT_TRUE(has_note(cone(0, 3), "cone angles out of range"));
}

TEST(GltfLight, NotesThatRangeIsIgnored) {
    EXPECT_TRUE(has_note(with_light({{"type", "point"}, {"range", 5}}).load(),
                         "range of lights is ignored"));
    EXPECT_FALSE(has_note(with_light({{"type", "point"}}).load(), "range"));
}

TEST(GltfLight, RejectsInvalidLights) {
    using ::testing::HasSubstr;
    EXPECT_THAT(with_light({{"type", "point"}, {"intensity", -1}}).problem(),
                HasSubstr("light 0 has an intensity"));
    EXPECT_THAT(with_light({{"type", "point"}, {"intensity", 1e300}}).problem(),
                HasSubstr("finite"));
    EXPECT_THAT(with_light({{"type", "point"}, {"intensity", "bright"}}).problem(),
                HasSubstr("not a number"));
    EXPECT_THAT(with_light({{"type", "point"}, {"color", {1, 1}}}).problem(),
                HasSubstr("not three numbers"));
    EXPECT_THAT(with_light({{"type", "area"}}).problem(),
                HasSubstr("neither a point, nor a spot, nor a directional"));
    EXPECT_THAT(with_light({{"type", "spot"}, {"spot", {{"outerConeAngle", 0}}}}).problem(),
                HasSubstr("cone angles"));
    EXPECT_THAT(with_light({{"type", "point"}}, {{"translation", {1e300, 0, 0}}}).problem(),
                HasSubstr("not finite"));
    for (const json& index : {json(1), json(-1), json("0"), json(0.5), json(4294967296)}) {
        GltfBuilder builder = with_light({{"type", "point"}});
        builder.root["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = index;
        EXPECT_THAT(builder.problem(), HasSubstr("node 1 refers to a light that does not exist"))
            << "index " << index;
    }
}

TEST(GltfLight, LeavesOutLightsWithoutADirection) {
    const Scene scene = with_light({{"type", "directional"}}, {{"scale", {1, 1, 0}}}).load();
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_TRUE(has_note(scene, "light 0 is left out"));
    EXPECT_EQ(with_light({{"type", "point"}}, {{"scale", {0, 0, 0}}}).load().lights.size(), 1u);
}

TEST(GltfLight, AddsAStudioIfThereIsNoLight) {
    const Scene scene = one_triangle().load();
    EXPECT_FALSE(scene.sky.has_value());
    ASSERT_TRUE(scene.environment.has_value());
    EXPECT_EQ(fingerprint(*scene.environment), fingerprint(studio()));
    EXPECT_TRUE(has_note(scene, "no light: a neutral studio"));
}

} // namespace
} // namespace argand
