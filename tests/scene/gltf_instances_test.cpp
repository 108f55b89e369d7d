// Meshes that are shown several times, files with several scenes, and integers written as floats.
#include "gltf_builder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace testing_gltf;
using ::testing::HasSubstr;

constexpr const char* instancing = "EXT_mesh_gpu_instancing";

/// The right triangle in these places.
GltfBuilder instanced(const std::vector<glm::vec3>& translations,
                      const std::vector<glm::vec4>& rotations = {},
                      const std::vector<glm::vec3>& scales = {}, json node = json::object()) {
    GltfBuilder builder;
    json attributes = json::object();
    if (!translations.empty()) {
        attributes["TRANSLATION"] = builder.add_vectors(translations);
    }
    if (!rotations.empty()) {
        attributes["ROTATION"] =
            builder.add_accessor(builder.add_view(rotations), float_type, "VEC4", rotations.size());
    }
    if (!scales.empty()) {
        attributes["SCALE"] = builder.add_vectors(scales);
    }
    node["extensions"][instancing]["attributes"] = attributes;
    builder.add_triangles(right_triangle(), node);
    builder.root["extensionsUsed"] = {instancing};
    builder.root["extensionsRequired"] = {instancing};
    return builder;
}

TEST(GltfInstances, AreInTheirPlacesWithinThatOfTheNode) {
    const float half = std::sqrt(0.5f);
    const Scene scene =
        instanced({{1, 0, 0}, {0, 2, 0}, {0, 0, 3}},
                  {{0, 0, 0, 1}, {0, 0, half, half}, {0, 0, 0, 2}}, // a quarter turn about z
                  {{1, 1, 1}, {2, 3, 1}, {-1, 1, 1}},
                  {{"translation", {10, 0, 0}}, {"name", "tree"}})
            .load();
    ASSERT_EQ(scene.triangles.size(), 3u);
    expect_near(corners_of(scene, 0)[1], {12, 0, 0});
    // (1, 0, 0) is scaled to (2, 0, 0), turned to (0, 2, 0) and moved.
    expect_near(corners_of(scene, 1)[1], {10, 4, 0});
    expect_near(corners_of(scene, 1)[2], {7, 2, 0});
    // A mirrored instance keeps its front.
    EXPECT_GT(winding_normal(scene, 2).z, 0);
    expect_near(corners_of(scene, 2)[0], {10, 0, 3});
    ASSERT_EQ(scene.objects.size(), 3u);
    for (const SceneObject& object : scene.objects) {
        EXPECT_EQ(object.node, 0u);
        EXPECT_EQ(object.name, "tree");
    }
    EXPECT_TRUE(scene.notes.empty() || !has_note(scene, instancing));
}

TEST(GltfInstances, FollowTheirNode) {
    GltfBuilder builder = instanced({{0, 0, 0}, {0, 5, 0}});
    const int times =
        builder.add_accessor(builder.add_view(std::vector<float>{0, 1}), float_type, "SCALAR", 2);
    const int places = builder.add_vectors({{0, 0, 0}, {4, 0, 0}});
    builder.root["animations"] = {
        {{"samplers", {{{"input", times}, {"output", places}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    const TempDirectory directory;
    const Scene scene = load_gltf(directory.write("scene.glb", builder.glb()), 0.5);
    ASSERT_EQ(scene.triangles.size(), 2u);
    ASSERT_EQ(scene.motion.meshes.size(), 2u);
    expect_near(corners_of(scene, 0)[0], {2, 0, 0});
    expect_near(corners_of(scene, 1)[0], {2, 5, 0});
}

TEST(GltfInstances, LeaveLightsAndCamerasOfTheNodeAlone) {
    GltfBuilder builder = instanced({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
    builder.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    builder.root["nodes"][0]["camera"] = 0;
    EXPECT_EQ(builder.load().cameras.size(), 1u);
}

TEST(GltfInstances, ThatAreNone) {
    EXPECT_THAT(instanced({}).problem(), HasSubstr("no attribute TRANSLATION, ROTATION or SCALE"));
    EXPECT_THAT(instanced({{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0, 1}}).problem(),
                HasSubstr("of 2 and of 1 elements"));
    EXPECT_THAT(instanced({}, {{0, 0, 0, 0}}).problem(), HasSubstr("not a unit quaternion"));
    const auto problem_with = [](const json& accessor) {
        GltfBuilder builder = instanced({{0, 0, 0}});
        builder.root["nodes"][0]["extensions"][instancing]["attributes"]["TRANSLATION"] = accessor;
        return builder.problem();
    };
    EXPECT_THAT(problem_with(99), HasSubstr("accessor 99, which does not exist"));
    EXPECT_THAT(problem_with("a"), HasSubstr("no accessor"));
    EXPECT_THAT(problem_with(-1), HasSubstr("no accessor"));
    // A few bytes that state millions of instances.
    GltfBuilder many = instanced({{0, 0, 0}});
    many.root["accessors"][0] = {
        {"componentType", float_type}, {"type", "VEC3"}, {"count", 3000000}};
    EXPECT_THAT(many.problem(), HasSubstr("more than 1048576 instances"));
}

/// Scenes "one" and "two" and one without a name, each with a triangle of its own.
GltfBuilder three_scenes() {
    GltfBuilder builder;
    for (int i = 0; i < 3; ++i) {
        builder.add_triangles(right_triangle(), {{"translation", {i, 0, 0}}});
    }
    builder.root["scenes"] = {
        {{"name", "one"}, {"nodes", {0}}}, {{"name", "two"}, {"nodes", {1}}}, {{"nodes", {2}}}};
    builder.root["scene"] = 1;
    return builder;
}

TEST(GltfScenes, AreChosenByNameOrIndex) {
    const TempDirectory directory;
    const auto file = directory.write("scene.glb", three_scenes().glb());
    const auto place_of = [&](const std::string& choice) {
        return load_gltf(file, {}, {.scene = choice}).positions.at(0).x;
    };
    EXPECT_EQ(place_of(""), 1);
    EXPECT_EQ(place_of("one"), 0);
    EXPECT_EQ(place_of("two"), 1);
    EXPECT_EQ(place_of("0"), 0);
    EXPECT_EQ(place_of("2"), 2);
    for (const char* none : {"three", "3", "-1", "1.0", "0x1", "99999999999999999999"}) {
        try {
            place_of(none);
            ADD_FAILURE() << none;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("no scene '" + std::string(none) + "'"));
            EXPECT_THAT(error.what(), HasSubstr("scene 0 \"one\", scene 1 \"two\", scene 2"));
        }
    }
}

// JSON has one kind of number: 1.0 and 1e0 are the integer 1.
TEST(GltfNumbers, IntegersMayBeWrittenAsFloats) {
    GltfBuilder builder = three_scenes();
    builder.root["extensionsUsed"] = {"KHR_lights_punctual"};
    builder.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    builder.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0.0;
    builder.root["scene"] = 0.0;
    builder.root["scenes"][0]["nodes"] = {0.0};
    builder.root["nodes"][0]["mesh"] = 0.0;
    builder.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 0.0;
    builder.root["meshes"][0]["primitives"][0]["mode"] = 4.0;
    for (json& accessor : builder.root["accessors"]) {
        for (const char* key : {"bufferView", "byteOffset", "componentType", "count"}) {
            accessor[key] = accessor[key].get<double>();
        }
    }
    for (json& view : builder.root["bufferViews"]) {
        for (const char* key : {"buffer", "byteOffset", "byteLength"}) {
            view[key] = view[key].get<double>();
        }
    }
    const std::string text = builder.root.dump();
    ASSERT_THAT(text, HasSubstr("\"count\":3.0"));
    const Scene scene = builder.load();
    ASSERT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(corners_of(scene, 0), right_triangle());
    EXPECT_EQ(scene.lights.size(), 1u);
}

TEST(GltfNumbers, FractionsAreNoIntegers) {
    for (const double number : {0.5, -1.0, 1e300, 1e16}) {
        GltfBuilder builder = one_triangle();
        builder.root["accessors"][0]["count"] = number;
        EXPECT_THAT(builder.problem(), HasSubstr("\"count\" must be an integer")) << number;
    }
}

} // namespace
} // namespace argand
