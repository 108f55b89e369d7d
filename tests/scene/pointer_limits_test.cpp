// KHR_animation_pointer: values beyond their ranges, and pointers that lead nowhere.
#include "pointed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace argand {
namespace {

using namespace testing_gltf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Pointer, ClampsValuesToTheirRanges) {
    const auto scene = [](const std::string& pointer, const std::vector<float>& value) {
        const char* type = value.size() == 1 ? "SCALAR" : value.size() == 3 ? "VEC3" : "VEC4";
        return with_value(stage(), pointer, type, value);
    };
    EXPECT_EQ(scene(to_lamp + "intensity", {-1}).lights[0].intensity, glm::vec3(0));
    EXPECT_EQ(scene(to_lamp + "color", {-1, 2, 0.5f}).lights[0].intensity, glm::vec3(0, 20, 5));
    EXPECT_EQ(scene(to_sun + "intensity", {3e38f}).lights[2].intensity, glm::vec3(3e38f));
    EXPECT_EQ(scene(to_lamp + "color", {3e38f, 0, 0}).lights[0].intensity.x,
              std::numeric_limits<float>::max());
    EXPECT_EQ(scene(to_lamp + "spot/innerConeAngle", {-1}).lights[0].inner_cone_angle, 0);
    EXPECT_EQ(scene(to_lamp + "spot/innerConeAngle", {2}).lights[0].inner_cone_angle, 1);
    EXPECT_EQ(scene(to_lamp + "spot/outerConeAngle", {3}).lights[0].outer_cone_angle,
              std::numbers::pi_v<float> / 2);
    EXPECT_GT(scene(to_lamp + "spot/outerConeAngle", {-3}).lights[0].outer_cone_angle, 0);

    const auto material = [&](const std::string& pointer, const std::vector<float>& value) {
        return scene(pointer, value).materials[0];
    };
    EXPECT_EQ(material(to_base_color, {-1, 0.5f, 7, 2}).base_color, glm::vec3(0, 0.5f, 1));
    EXPECT_EQ(material(to_base_color, {-1, 0.5f, 7, 2}).coverage, 1);
    EXPECT_EQ(material(to_base_color, {1, 1, 1, -2}).coverage, 0);
    EXPECT_EQ(material(to_base_color, {1, 1, 1, -2}).emission, glm::vec3(0));
    EXPECT_EQ(material(to_material + "pbrMetallicRoughness/metallicFactor", {1.5f}).metallic, 1);
    EXPECT_EQ(material(to_material + "pbrMetallicRoughness/roughnessFactor", {-0.1f}).roughness, 0);
    EXPECT_EQ(material(to_material + "emissiveFactor", {-1, 0, 3}).emission, glm::vec3(0, 0, 6));
    EXPECT_EQ(material(to_strength, {-1}).emission, glm::vec3(0));
    EXPECT_EQ(material(to_strength, {3e38f}).emission, glm::vec3(3e38f, 1.5e38f, 0.75e38f));
    EXPECT_EQ(material(to_transmission, {1.25f}).transmission, 1);
    EXPECT_EQ(material(to_ior, {0}).ior, 0); // Fresnel's factor is 1
    EXPECT_EQ(material(to_ior, {0.5f}).ior, 1);
    EXPECT_EQ(material(to_ior, {-4}).ior, 1);

    const auto angle = [&](float value) {
        return scene("/cameras/0/perspective/yfov", {value}).cameras[0].vertical_angle;
    };
    EXPECT_GT(angle(-1), 0);
    EXPECT_LT(double(angle(4)), std::numbers::pi);
    EXPECT_GT(angle(4), 3.14159f);
    const auto extent = [&](float value) {
        return scene("/cameras/1/orthographic/ymag", {value}).cameras[1].vertical_extent;
    };
    EXPECT_EQ(extent(-3), 3); // as at rest
    EXPECT_GT(extent(0), 0);
}

TEST(Pointer, ClampsSplinesThatOvershoot) {
    // From 0 to 1 with slopes of -8 and 8 per second: far below 0, then far above 1.
    Animated file = stage();
    file.animate_pointer(to_material + "pbrMetallicRoughness/roughnessFactor", {0, 1}, "SCALAR",
                         {0, 0, -8, -8, 1, 0}, "CUBICSPLINE");
    file.animate_pointer(to_lamp + "intensity", {0, 1}, "SCALAR", {0, 0, -8, 8, 1, 0},
                         "CUBICSPLINE");
    EXPECT_EQ(file.load(0.25).materials[0].roughness, 0);
    EXPECT_EQ(file.load(0.25).lights[0].intensity, glm::vec3(0));
    EXPECT_EQ(file.load(0.75).materials[0].roughness, 1);
    EXPECT_EQ(file.load(1.0).lights[0].intensity.x, 1);
}

TEST(Pointer, LimitsTheBaseColourOfPhongMaterials) {
    Animated file = stage();
    json& material = file.builder.root["materials"][0];
    material["pbrMetallicRoughness"]["baseColorFactor"] = {0.25, 0.25, 0.25, 1};
    material["extras"]["phong"] = {{"specular", {0.5, 0.25, 0.75}}, {"exponent", 3}};
    EXPECT_EQ(with_value(file, to_base_color, "VEC4", {1, 0.5f, 0, 1}).materials[0].base_color,
              glm::vec3(0.5f, 0.5f, 0));
}

TEST(Pointer, WhatIsNotSupportedIsNotedOnce) {
    const auto notes_on = [](const std::vector<std::string>& pointers) {
        Animated file = stage();
        for (const std::string& pointer : pointers) {
            // No such sampler is ever read.
            file.animate_pointer(pointer, {2, 1}, "SCALAR", {std::nanf("")});
        }
        std::vector<std::string> notes = file.load(1.0).notes;
        EXPECT_THAT(notes, Not(Contains(HasSubstr("not quite valid"))));
        std::erase_if(notes, [](const std::string& note) {
            return note.find("are not supported yet") == std::string::npos;
        });
        return notes;
    };
    for (const std::string pointer :
         {"", "/", "x", "/materials", "/materials/0", "/materials/0/", "/materials//emissiveFactor",
          "/materials/01/emissiveFactor", "/materials/-1/emissiveFactor",
          "/materials/0/emissiveFactor/0", "/materials/9/normalTexture/scale", "/nodes/9/visible",
          "/meshes/0/weights", "/cameras/0/perspective/znear",
          "/extensions/KHR_lights_punctual/lights/0/range",
          "/materials/0/extensions/KHR_texture_transform/offset"}) {
        EXPECT_EQ(notes_on({pointer, pointer}),
                  std::vector<std::string>{"animations of " + pointer + " are not supported yet"});
    }
    std::vector<std::string> many;
    for (int i = 0; i < 50; ++i) {
        many.push_back("/x/" + std::to_string(i));
    }
    const std::vector<std::string> notes = notes_on(many);
    EXPECT_EQ(notes.size(), 21u);
    EXPECT_EQ(notes.back(), "animations of 30 more are not supported yet");
}

TEST(Pointer, MalformedOnesAreErrors) {
    const auto problem = [](const std::string& pointer, const char* type,
                            const std::vector<float>& values,
                            const std::vector<float>& times = {0}) {
        Animated file = stage();
        file.animate_pointer(pointer, times, type, values);
        return file.builder.problem();
    };
    EXPECT_EQ(problem(to_lamp + "intensity", "SCALAR", {1}), "");
    // Objects that are not there.
    EXPECT_THAT(problem("/materials/1/emissiveFactor", "VEC3", {1, 1, 1}),
                HasSubstr("animation 0 moves material 1, which does not exist"));
    EXPECT_THAT(problem("/materials/99999999999999999999/emissiveFactor", "VEC3", {1, 1, 1}),
                HasSubstr("which does not exist"));
    EXPECT_THAT(problem("/extensions/KHR_lights_punctual/lights/2/color", "VEC3", {1, 1, 1}),
                HasSubstr("moves light 2, which does not exist"));
    EXPECT_THAT(problem("/cameras/2/perspective/yfov", "SCALAR", {1}),
                HasSubstr("moves camera 2, which does not exist"));
    EXPECT_THAT(problem("/nodes/77/scale", "VEC3", {1, 1, 1}),
                HasSubstr("moves node 77, which does not exist"));
    EXPECT_THAT(problem("/nodes/0/weights", "SCALAR", {1}),
                HasSubstr("moves the morph targets of node 0, which has none"));
    EXPECT_THAT(
        problem("/cameras/1/perspective/yfov", "SCALAR", {1}),
        HasSubstr("moves the angle of view of camera 1, whose type is not \"perspective\""));
    EXPECT_THAT(problem("/cameras/0/orthographic/ymag", "SCALAR", {1}),
                HasSubstr("camera 0, whose type is not \"orthographic\""));
    EXPECT_THAT(problem(to_sun + "spot/innerConeAngle", "SCALAR", {1}),
                HasSubstr("light 1, whose type is not \"spot\""));
    // Keys that do not fit.
    EXPECT_THAT(problem(to_lamp + "intensity", "VEC3", {1, 1, 1}),
                HasSubstr("sampler 0 of animation 0 has 1 values of 3 numbers, but its 1 keys need "
                          "1 of 1"));
    EXPECT_THAT(problem(to_base_color, "VEC3", {1, 1, 1}), HasSubstr("need 1 of 4"));
    EXPECT_THAT(problem(to_strength, "SCALAR", {1, 2}), HasSubstr("has 2 values of 1 numbers"));
    EXPECT_THAT(problem(to_strength, "SCALAR", {std::nanf("")}),
                HasSubstr("value 0 of sampler 0 of animation 0 is not finite"));
    EXPECT_THAT(problem(to_strength, "SCALAR", {1, 2}, {2, 1}),
                HasSubstr("the times of sampler 0 of animation 0 do not rise: key 1 is at 1 s"));
    EXPECT_THAT(problem(to_strength, "SCALAR", {1, 2}, {0, std::nanf("")}),
                HasSubstr("do not rise"));
    EXPECT_THAT(problem("/nodes/0/rotation", "VEC4", {0, 0, 0, 0}),
                HasSubstr("is not a unit quaternion"));

    const auto with = [&](const char* pointer, const json& value) {
        Animated file = stage();
        file.animate_pointer(to_lamp + "intensity", {0}, "SCALAR", {1});
        json& animation = file.builder.root["animations"][0];
        if (value.is_null()) {
            animation["channels"][0].erase("sampler");
        } else {
            animation[json::json_pointer(pointer)] = value;
        }
        return file.builder.problem();
    };
    EXPECT_THAT(with("/channels/0/sampler", 3), HasSubstr("sampler 3, which does not exist"));
    EXPECT_THAT(with("", nullptr), HasSubstr("intensity of light 0 \"lamp\" by no sampler"));
    EXPECT_THAT(with("/channels/0/target/extensions/KHR_animation_pointer/pointer", 5),
                HasSubstr("animation 0 moves a \"pointer\" but has no KHR_animation_pointer"));
    // The validator takes a channel without the extension; it moves nothing.
    EXPECT_EQ(with("/channels/0/target/extensions", json::object()), "");
    EXPECT_THAT(with("/samplers/0/interpolation", "WAVY"), HasSubstr("interpolation \"WAVY\""));
    EXPECT_EQ(with("/channels/0/target/node", 0), ""); // to be ignored beside a pointer
}

} // namespace
} // namespace argand
