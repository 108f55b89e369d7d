// KHR_animation_pointer: lights, materials and cameras against closed formulas, nodes against the
// channels that glTF 2.0 has for them.
#include "pointed.hpp"
#include "scene/pose.hpp"
#include "scene/summary.hpp"

#include <algorithm>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace testing_gltf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

using Values = std::vector<double>;

Values values_of(const glm::vec3& v) { return {v.x, v.y, v.z}; }

void expect_close(const Values& found, const Values& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i], expected[i], 1e-6 * std::abs(expected[i])) << i;
    }
}

/// What a pointer moves, and how it shows in the scene.
struct Case {
    std::string pointer;
    const char* type;
    double least; ///< of the values that the test gives it
    std::function<Values(const Scene&)> shown;
    Values scale; ///< of what is shown to the values
};

const Material& screen_of(const Scene& scene) { return scene.materials[0]; }

std::vector<Case> all_cases() {
    const Values plain{1, 1, 1};
    const auto factor = [](float Material::*member) {
        return [member](const Scene& s) { return Values{screen_of(s).*member}; };
    };
    const std::string extensions = to_material + "extensions/KHR_materials_";
    return {
        {to_lamp + "color",
         "VEC3",
         0,
         [](const Scene& s) { return values_of(s.lights[0].intensity); },
         {10, 10, 10}},
        {to_lamp + "intensity",
         "SCALAR",
         0,
         [](const Scene& s) { return Values{s.lights[1].intensity.y}; },
         {0.5}},
        {to_lamp + "spot/innerConeAngle", "SCALAR", 0,
         [](const Scene& s) { return Values{s.lights[0].inner_cone_angle}; }, plain},
        {to_lamp + "spot/outerConeAngle", "SCALAR", 0,
         [](const Scene& s) { return Values{s.lights[1].outer_cone_angle}; }, plain},
        {to_sun + "color", "VEC3", 0,
         [](const Scene& s) { return values_of(s.lights[2].intensity); }, plain},
        {to_base_color,
         "VEC4",
         0,
         [](const Scene& s) {
             Values color = values_of(screen_of(s).base_color);
             color.push_back(screen_of(s).coverage);
             return color;
         },
         {1, 1, 1, 1}},
        {to_material + "pbrMetallicRoughness/metallicFactor", "SCALAR", 0,
         factor(&Material::metallic), plain},
        {to_material + "pbrMetallicRoughness/roughnessFactor", "SCALAR", 0,
         factor(&Material::roughness), plain},
        {to_material + "emissiveFactor",
         "VEC3",
         0,
         [](const Scene& s) { return values_of(screen_of(s).emission); },
         {2, 2, 2}},
        {to_strength,
         "SCALAR",
         0,
         [](const Scene& s) { return Values{screen_of(s).emission.z}; },
         {0.25}},
        {extensions + "specular/specularFactor", "SCALAR", 0, factor(&Material::specular), plain},
        {extensions + "specular/specularColorFactor", "VEC3", 1,
         [](const Scene& s) { return values_of(screen_of(s).specular_color); }, plain},
        {to_transmission, "SCALAR", 0, factor(&Material::transmission), plain},
        {to_ior, "SCALAR", 1, factor(&Material::ior), plain},
        {extensions + "volume/thicknessFactor", "SCALAR", 5, factor(&Material::thickness), plain},
        {extensions + "volume/attenuationDistance", "SCALAR", 1,
         [](const Scene& s) {
             // What is left of the red of 0.5 after the distance.
             return Values{std::log(2.0) / double(screen_of(s).absorption.r)};
         },
         plain},
        {extensions + "volume/attenuationColor", "VEC3", 0,
         [](const Scene& s) {
             const glm::dvec3 left = glm::exp(-2.0 * glm::dvec3(screen_of(s).absorption));
             return values_of(glm::vec3(left));
         },
         plain},
        {extensions + "clearcoat/clearcoatFactor", "SCALAR", 0, factor(&Material::coat), plain},
        {extensions + "clearcoat/clearcoatRoughnessFactor", "SCALAR", 0,
         factor(&Material::coat_roughness), plain},
        {extensions + "dispersion/dispersion", "SCALAR", 0, factor(&Material::dispersion), plain},
        {extensions + "sheen/sheenRoughnessFactor", "SCALAR", 0, factor(&Material::sheen_roughness),
         plain},
        {extensions + "anisotropy/anisotropyStrength", "SCALAR", 0,
         [](const Scene& s) { return Values{double(glm::length(screen_of(s).anisotropy))}; },
         plain},
        {extensions + "iridescence/iridescenceFactor", "SCALAR", 0, factor(&Material::film), plain},
        {extensions + "iridescence/iridescenceIor", "SCALAR", 1, factor(&Material::film_ior),
         plain},
        {extensions + "iridescence/iridescenceThicknessMaximum", "SCALAR", 100,
         [](const Scene& s) { return Values{1000 * double(screen_of(s).film_thickness)}; }, plain},
        {"/cameras/0/perspective/yfov", "SCALAR", 1,
         [](const Scene& s) { return Values{s.cameras[0].vertical_angle}; }, plain},
        {"/cameras/1/orthographic/ymag", "SCALAR", 1,
         [](const Scene& s) { return Values{s.cameras[1].vertical_extent}; }, plain},
    };
}

/// A cubic polynomial between 0.3 and 0.7 for each component, from 1 to 4 s.
double course(double t, std::size_t component) {
    return 0.3 + 0.05 * double(component) + 0.1 * t - 0.03 * t * t + 0.004 * t * t * t;
}

double course_slope(double t) { return 0.1 - 0.06 * t + 0.012 * t * t; }

/// The course as keys at 1, 2 and 4 s show it.
double expected_at(double t, std::size_t component, const std::string& interpolation) {
    const double from = t < 2 ? 1 : 2, to = t < 2 ? 2 : 4;
    if (t <= 1 || t >= 4) {
        return course(t <= 1 ? 1 : 4, component);
    }
    if (interpolation == "STEP") {
        return course(from, component);
    }
    const double share = (t - from) / (to - from);
    return interpolation == "LINEAR"
               ? (1 - share) * course(from, component) + share * course(to, component)
               : course(t, component);
}

std::vector<float> keys_of(const Case& moved, std::size_t width, bool spline) {
    std::vector<float> keys;
    const auto add = [&](const auto& value) {
        for (std::size_t i = 0; i < width; ++i) {
            keys.push_back(static_cast<float>(value(i)));
        }
    };
    for (const double t : {1.0, 2.0, 4.0}) {
        if (spline) {
            add([&](std::size_t) { return course_slope(t); });
        }
        add([&](std::size_t i) { return moved.least + course(t, i); });
        if (spline) {
            add([&](std::size_t) { return course_slope(t); });
        }
    }
    return keys;
}

TEST(Pointer, MovesEveryProperty) {
    for (const Case& moved : all_cases()) {
        SCOPED_TRACE(moved.pointer);
        const Values at_rest = moved.shown(stage().load({}));
        for (const std::string interpolation : {"STEP", "LINEAR", "CUBICSPLINE"}) {
            SCOPED_TRACE(interpolation);
            Animated file = stage();
            file.animate_pointer(moved.pointer, {1, 2, 4}, moved.type,
                                 keys_of(moved, at_rest.size(), interpolation == "CUBICSPLINE"),
                                 interpolation.c_str());
            Scene scene = file.load({});
            EXPECT_THAT(scene.notes, Not(Contains(HasSubstr("animations of"))));
            EXPECT_EQ(moved.shown(scene), at_rest);
            for (const double time : {4.0, -1.0, 1.0, 1.25, 2.0, 3.5, 9.0}) {
                move_to(time, scene);
                Values expected;
                for (std::size_t i = 0; i < at_rest.size(); ++i) {
                    expected.push_back(moved.scale[i] *
                                       (moved.least + expected_at(time, i, interpolation)));
                }
                expect_close(moved.shown(scene), expected);
                EXPECT_EQ(moved.shown(scene), moved.shown(file.load(time)));
            }
        }
    }
}

TEST(Pointer, MovesNodesAsTheirChannelsDo) {
    struct Move {
        const char* path;
        const char* type;
        std::vector<float> values;
    };
    for (const Move& move :
         {Move{"translation", "VEC3", {0, 0, 0, 4, 0, 2}},
          Move{"rotation", "VEC4", {0, 0, 0, 1, 0, 0, 1, 0}},
          Move{"scale", "VEC3", {1, 1, 1, -2, 3, 1}}, Move{"weights", "SCALAR", {0, 0, 0.5f, 1}}}) {
        SCOPED_TRACE(move.path);
        Animated file = stage();
        const int morph = file.builder.add_vectors({{0, 0, 1}, {0, 0, 2}, {0, 0, 3}});
        file.builder.root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", morph}},
                                                                      {{"POSITION", morph}}};
        file.animate_pointer(std::string("/nodes/0/") + move.path, {1, 3}, move.type, move.values);
        Animated classic = file;
        classic.builder.root["animations"][0]["channels"][0]["target"] = {{"node", 0},
                                                                          {"path", move.path}};
        for (const double time : {0.0, 1.5, 2.75, 4.0}) {
            EXPECT_EQ(file.load(time).positions, classic.load(time).positions) << time;
        }
        EXPECT_NE(file.load(2.0).positions, stage().load({}).positions);
        EXPECT_EQ(file.load({}).animations[0].moves, classic.load({}).animations[0].moves);
    }
}

TEST(Pointer, KeysThatEqualTheFileChangeNoBit) {
    Animated file = stage();
    file.builder.root["materials"][0]["emissiveFactor"] = {0.1, 0.7, 0.3};
    file.builder.root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.1, 0.2, 0.3,
                                                                                    0.7};
    file.animate_pointer(to_material + "emissiveFactor", {0}, "VEC3", {0.1f, 0.7f, 0.3f});
    file.animate_pointer(to_base_color, {0}, "VEC4", {0.1f, 0.2f, 0.3f, 0.7f});
    const Scene rest = file.load({}), moved = file.load(1.0);
    EXPECT_EQ(rest.materials[0].emission, moved.materials[0].emission);
    EXPECT_EQ(rest.materials[0].base_color, moved.materials[0].base_color);
    EXPECT_EQ(rest.materials[0].coverage, moved.materials[0].coverage);
}

TEST(Pointer, WhatIsDarkAtRestMayShineLater) {
    Animated lit = stage();
    lit.builder.root["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 0;
    lit.animate_pointer(to_lamp + "intensity", {0, 1}, "SCALAR", {0, 4});
    EXPECT_EQ(lit.load({}).lights.size(), 3u);
    EXPECT_EQ(lit.load({}).lights[0].intensity, glm::vec3(0));
    EXPECT_EQ(lit.load(1.0).lights[1].intensity, glm::vec3(4, 2, 1));

    // A screen that is switched on, by either factor, in a scene without other light.
    for (const bool by_strength : {false, true}) {
        Animated screen;
        screen.builder.add_triangles(right_triangle());
        screen.builder.root["meshes"][0]["primitives"][0]["material"] = 0;
        json& material = screen.builder.root["materials"][0];
        material = {{"emissiveFactor", {1, 1, 1}}};
        if (by_strength) {
            material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 0;
            screen.animate_pointer(to_strength, {0, 1}, "SCALAR", {0, 5});
        } else {
            material["emissiveFactor"] = {0, 0, 0};
            screen.animate_pointer(to_material + "emissiveFactor", {0, 1}, "VEC3",
                                   {0, 0, 0, 5, 5, 5});
        }
        EXPECT_FALSE(screen.load({}).environment);
        EXPECT_FALSE(emits(screen.load({}).materials[0]));
        EXPECT_EQ(screen.load(1.0).materials[0].emission, glm::vec3(5));
        // What never shines is no light.
        screen.builder.root["animations"].clear();
        EXPECT_TRUE(screen.load({}).environment);
    }
}

TEST(Pointer, WhatIsInvisibleAtRestMayAppearLater) {
    for (const char* mode : {"BLEND", "MASK"}) {
        Animated file = stage();
        json& material = file.builder.root["materials"][0];
        material["alphaMode"] = mode;
        material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0};
        EXPECT_THAT(file.builder.problem(), HasSubstr("nothing to render"));
        file.animate_pointer(to_base_color, {0, 1}, "VEC4", {1, 1, 1, 0, 1, 1, 1, 1});
        EXPECT_EQ(file.load({}).triangles.size(), 1u);
        EXPECT_EQ(file.load({}).materials[0].coverage, 0);
        EXPECT_EQ(file.load(0.75).materials[0].coverage, mode[0] == 'B' ? 0.75f : 1);
        EXPECT_EQ(file.load(0.25).materials[0].coverage, mode[0] == 'B' ? 0.25f : 0);
        EXPECT_EQ(file.load(1.0).materials[0].emission, glm::vec3(2, 1, 0.5f));
    }
    Animated cutoff = stage();
    cutoff.builder.root["materials"][0]["alphaMode"] = "MASK";
    cutoff.animate_pointer(to_material + "alphaCutoff", {0, 1}, "SCALAR", {0.5f, 1.5f});
    EXPECT_EQ(cutoff.load(0.0).materials[0].coverage, 1);
    EXPECT_EQ(cutoff.load(1.0).materials[0].coverage, 0);
}

TEST(Pointer, WhatIsThinAtRestMayBecomeASolidWithAPriority) {
    Animated file = stage();
    file.builder.root["materials"][0]["extras"]["priority"] = 3;
    file.builder.root["materials"][0]["extensions"]["KHR_materials_transmission"] = {
        {"transmissionFactor", 1}};
    EXPECT_EQ(screen_of(file.load(1.0)).priority, 0);
    const Scene scene = with_value(
        file, to_material + "extensions/KHR_materials_volume/thicknessFactor", "SCALAR", {2});
    EXPECT_EQ(screen_of(scene).priority, 3);
    EXPECT_EQ(scene.solids->materials, std::vector<std::uint32_t>{0});
}

TEST(Pointer, MovesALightWhoseNodeMovesToo) {
    Animated file = stage();
    file.animate(1, "translation", {0, 1}, {{0, 0, 0}, {8, 0, 0}});
    file.animate_pointer(to_lamp + "intensity", {0, 1}, "SCALAR", {0, 4});
    const Scene scene = file.load(0.5);
    EXPECT_EQ(scene.lights[0].position, glm::vec3(4, 0, 0));
    EXPECT_EQ(scene.lights[1].position, glm::vec3(0, 0, 3)); // another node's
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(2, 1, 0.5f));
    EXPECT_EQ(scene.lights[1].intensity, glm::vec3(2, 1, 0.5f));
    EXPECT_EQ(scene.motion.light_keys.size(), 1u);
}

TEST(Pointer, TheFirstAnimationThatMovesAPropertyCounts) {
    Animated file = stage();
    file.animate_pointer(to_lamp + "intensity", {0}, "SCALAR", {7});
    file.animate_pointer(to_lamp + "intensity", {5}, "SCALAR", {9});
    file.animate_pointer("/nodes/0/translation", {0}, "VEC3", {1, 1, 1});
    file.animate(0, "translation", {0}, {{2, 2, 2}});
    const Scene scene = file.load(1.0);
    EXPECT_EQ(scene.lights[0].intensity.x, 7);
    EXPECT_EQ(corners_of(scene, 0)[0], glm::vec3(1, 1, 1));
    EXPECT_TRUE(scene.animations[1].moves.empty());
    EXPECT_THAT(scene.notes,
                Contains("several animations move one property; the first one counts"));
}

TEST(Pointer, SummariesListWhatMoves) {
    Animated file = stage();
    file.animate_pointer(to_lamp + "intensity", {0, 2}, "SCALAR", {7, 8});
    file.animate_pointer(to_material + "emissiveFactor", {0}, "VEC3", {7, 8, 9});
    file.animate_pointer("/cameras/0/perspective/yfov", {0}, "SCALAR", {1});
    file.builder.root["extensionsUsed"] =
        file.builder.root["extensionsRequired"] = {"KHR_animation_pointer"};
    const std::string text = summary_text(file.load({}));
    EXPECT_THAT(text, HasSubstr("2 s, moves intensity of light 0 \"lamp\"\n"));
    EXPECT_THAT(text, HasSubstr("moves emission of material 0 \"screen\"\n"));
    EXPECT_THAT(text, HasSubstr("moves angle of view of camera 0\n"));
    EXPECT_THAT(text, HasSubstr("0 vertices, 0 emissive triangles, 0 skins, 2 punctual lights, 1 "
                                "cameras, 1 materials"));
    EXPECT_THAT(text, Not(HasSubstr("not supported")));
}

} // namespace
} // namespace argand
