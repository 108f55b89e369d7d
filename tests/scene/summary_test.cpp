#include "gltf_builder.hpp"
#include "scene/gltf.hpp"
#include "scene/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

namespace argand {
namespace {

using namespace testing_gltf;
using ::testing::HasSubstr;

TEST(Describe, NamesEachKindOfMaterial) {
    const auto kind = [](float metallic, float roughness, float specular, float transmission,
                         float thickness) {
        Material material;
        material.metallic = metallic;
        material.roughness = roughness;
        material.specular = specular;
        material.transmission = transmission;
        material.thickness = thickness;
        return describe(material);
    };
    EXPECT_EQ(kind(0, 1, 0, 0, 0), "Lambertian");
    EXPECT_EQ(kind(0, 1, 1, 0, 0), "dielectric");
    EXPECT_EQ(kind(1, 0, 1, 0, 0), "mirror");
    EXPECT_EQ(kind(1, 0.5f, 1, 0, 0), "metal");
    EXPECT_EQ(kind(0.5f, 0.5f, 1, 0, 0), "part metal");
    EXPECT_EQ(kind(0, 0, 1, 1, 1), "glass");
    EXPECT_EQ(kind(0, 0, 1, 1, 0), "thin glass");
    EXPECT_EQ(kind(0, 0, 1, 0.5f, 1), "part glass");
    EXPECT_EQ(kind(1, 0, 1, 1, 1), "mirror"); // metal does not transmit
    Material brushed;
    brushed.metallic = 1;
    brushed.roughness = 0;
    brushed.anisotropy = {0, 0.5f};
    EXPECT_EQ(describe(brushed), "metal");
}

TEST(Describe, NamesUnlitSurfaces) {
    Material material;
    material.unlit = true;
    EXPECT_EQ(describe(material), "unlit");
}

/// A lamp and a wall, all kinds of lights, a camera, an animation, and an unsupported extension.
Scene rich_scene() {
    GltfBuilder builder;
    builder.root["materials"] = {
        {{"name", "lamp"},
         {"emissiveFactor", {1, 1, 1}},
         {"pbrMetallicRoughness", {{"metallicFactor", 0}}}},
        {{"name", "wall"},
         {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}},
         {"pbrMetallicRoughness", {{"metallicFactor", 0}}}}};
    builder.add_triangles({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}});
    builder.add_triangles({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 2}, {1, 0, 2}, {0, 1, 2}});
    builder.root["meshes"][0]["primitives"][0]["material"] = 0;
    builder.root["meshes"][1]["primitives"][0]["material"] = 1;
    builder.root["extensionsUsed"] = {"KHR_lights_punctual", "EXT_something"};
    builder.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"name", "bulb"}, {"intensity", 2}},
        {{"type", "directional"}, {"name", "sun"}, {"intensity", 3}},
        {{"type", "spot"}, {"name", "stage"}, {"spot", {{"outerConeAngle", 0.5}}}}};
    for (int light = 0; light < 3; ++light) {
        builder.add_node({{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    }
    builder.root["cameras"] = {{{"type", "perspective"},
                                {"name", "main"},
                                {"perspective", {{"yfov", 0.5}, {"znear", 1}}}}};
    builder.add_node({{"camera", 0}});
    builder.root["animations"] = {{{"channels", json::array()}, {"samplers", json::array()}}};
    return builder.load();
}

TEST(Summary, CountsAndMeasuresInJson) {
    const json summary(summary_json(rich_scene()));
    EXPECT_EQ(summary["name"], "scene.glb");
    EXPECT_EQ(summary["triangles"], 3);
    EXPECT_EQ(summary["vertices"], 9);
    EXPECT_DOUBLE_EQ(summary["area"], 3.0);
    EXPECT_EQ(summary["bounds"]["low"], json({0, 0, 0}));
    EXPECT_EQ(summary["bounds"]["high"], json({2, 2, 2}));
    ASSERT_EQ(summary["animations"].size(), 1u);
    EXPECT_EQ(summary["animations"][0]["seconds"], 0);
    EXPECT_TRUE(summary["sky"].is_null());

    ASSERT_EQ(summary["materials"].size(), 2u);
    EXPECT_EQ(summary["materials"][0]["kind"], "dielectric");
    EXPECT_EQ(summary["materials"][1]["kind"], "Lambertian");
    EXPECT_EQ(summary["materials"][1]["triangles"], 2);
    EXPECT_DOUBLE_EQ(summary["materials"][1]["area"], 1.0);

    EXPECT_EQ(summary["emissive"]["triangles"], 1);
    EXPECT_DOUBLE_EQ(summary["emissive"]["area"], 2.0);
    EXPECT_DOUBLE_EQ(summary["emissive"]["power"][0], 2 * std::numbers::pi);

    ASSERT_EQ(summary["lights"].size(), 3u);
    EXPECT_EQ(summary["lights"][0]["kind"], "point");
    EXPECT_DOUBLE_EQ(summary["lights"][0]["power"][0], 8 * std::numbers::pi);
    EXPECT_EQ(summary["lights"][1]["unit"], "lux");
    EXPECT_FALSE(summary["lights"][1].contains("power"));
    EXPECT_EQ(summary["lights"][2]["kind"], "spot");

    ASSERT_EQ(summary["cameras"].size(), 1u);
    EXPECT_EQ(summary["cameras"][0]["name"], "main");
    EXPECT_TRUE(summary["cameras"][0]["aspect"].is_null());
    EXPECT_EQ(summary["extensions"], json({{{"name", "KHR_lights_punctual"}, {"understood", true}},
                                           {{"name", "EXT_something"}, {"understood", false}}}));
}

TEST(Summary, TextHasTheSameContents) {
    const std::string text = summary_text(rich_scene());
    for (const char* part :
         {"triangles   3 over 9 vertices", "bounds      0 0 0 to 2 2 2", "lamp: dielectric",
          "emits 1 cd/m2", "wall: Lambertian", "bulb: point, 2 candela, power 25.13",
          "sun: directional, 3 lux", "stage: spot", "cone 0 to 28.65 degrees",
          "emissive    1 triangles, area 2, power 6.283", "sky         none",
          "main: perspective, 28.65 degrees high", "animations  1", "s, moves nothing",
          "EXT_something (not supported)"}) {
        EXPECT_THAT(text, HasSubstr(part));
    }
    EXPECT_EQ(text.back(), '\n');
}

TEST(Summary, ReportsAlpha) {
    GltfBuilder builder = one_triangle();
    builder.root["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.25}}}}, {"alphaMode", "BLEND"}}};
    builder.root["meshes"][0]["primitives"][0]["material"] = 0;
    EXPECT_EQ(summary_json(builder.load())["materials"][0]["alpha"], 0.25);
    EXPECT_THAT(summary_text(builder.load()), HasSubstr("roughness 1, alpha 0.25"));
}

TEST(Summary, SaysWhereAlphaVaries) {
    const Scene scene = load_gltf(ARGAND_SOURCE_DIR "/assets/cutouts.glb");
    int cut_out = 0, vary = 0;
    const auto summary = summary_json(scene);
    for (const auto& material : summary["materials"]) {
        cut_out += material["cut_out"].get<bool>() ? 1 : 0;
        vary += material["alpha_varies"].get<bool>() ? 1 : 0;
    }
    EXPECT_EQ(cut_out, 2); // the lantern and the plant
    EXPECT_EQ(vary, 3);    // and the pane
    EXPECT_THAT(summary_text(scene), HasSubstr("roughness 1, cut out by alpha, base_color"));
    EXPECT_THAT(summary_text(scene), HasSubstr("alpha 0.9, alpha varies, base_color"));
}

TEST(Summary, ReportsPhong) {
    GltfBuilder builder = one_triangle();
    builder.root["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}}},
         {"extras", {{"phong", {{"specular", {0.5, 0.25, 0}}, {"exponent", 20}}}}}}};
    builder.root["meshes"][0]["primitives"][0]["material"] = 0;
    const json material = summary_json(builder.load())["materials"][0];
    EXPECT_EQ(material["kind"], "Phong");
    EXPECT_EQ(material["phong"], json({{"specular", {0.5, 0.25, 0}}, {"exponent", 20}}));
    EXPECT_TRUE(summary_json(one_triangle().load())["materials"][0]["phong"].is_null());
    EXPECT_THAT(
        summary_text(builder.load()),
        HasSubstr("Phong, base colour 0.5, specular colour 0.5 0.25 0, exponent 20 (1 tri"));
}

TEST(Summary, ReportsWhatMoves) {
    Scene scene = rich_scene(); // its first triangle is the lamp
    for (const std::size_t triangle : {0, 1}) {
        scene.motion.meshes.push_back({.first_triangle = triangle, .triangles = 1});
        scene.motion.meshes.back().positions.resize(3);
    }
    EXPECT_EQ(summary_json(scene)["moving"]["vertices"], 6);
    EXPECT_EQ(summary_json(scene)["moving"]["emissive_triangles"], 1);
    scene.animations.emplace_back();
    EXPECT_THAT(summary_text(scene),
                HasSubstr("6 vertices, 1 emissive triangles, 0 skins, 0 punctual lights"));
}

TEST(Summary, ReportsAddedObjects) {
    const std::string text = summary_text(one_triangle().load());
    EXPECT_THAT(text, HasSubstr("sky         studio, 1 × 64 texels, mean radiance "));
    EXPECT_THAT(text, HasSubstr("there is no camera"));
}

} // namespace
} // namespace argand
