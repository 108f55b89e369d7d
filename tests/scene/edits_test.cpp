#include "animated.hpp"
#include "scene/edits.hpp"
#include "scene/pose.hpp"
#include "scene/scene_editor.hpp"
#include "support/expect_error.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace testing_gltf;
using testing::error_of;
using ::testing::HasSubstr;

Edits edits_of(const char* text) { return parse_edits(json::parse(text), "e.json"); }

/// A triangle on the node "body", a lamp and a camera on nodes of their own. The lamp and the body
/// move by 1 along x in the first second.
Animated file() {
    Animated file{one_triangle()};
    json& root = file.builder.root;
    root["nodes"][0]["name"] = "body";
    root["nodes"][0]["translation"] = {0, 0, 0};
    root["materials"] = {{{"name", "paint"}}, {{"name", "other"}}};
    root["meshes"][0]["primitives"][0]["material"] = 0;
    root["extensionsUsed"] = {"KHR_lights_punctual"};
    root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"name", "lamp"}, {"intensity", 3}, {"spot", json::object()}}};
    file.builder.add_node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    root["cameras"] = {
        {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    file.builder.add_node({{"camera", 0}, {"translation", {0, 0, 5}}});
    for (const int node : {0, 1}) {
        file.animate(node, "translation", {0, 1}, {{0, 0, 0}, {1, 0, 0}});
    }
    return file;
}

Scene load(const Animated& animated, std::optional<double> seconds, bool movable_nodes = false) {
    const TempDirectory directory;
    return load_gltf(directory.write("scene.glb", animated.builder.glb()), seconds,
                     {.movable_nodes = movable_nodes});
}

TEST(Edits, NameTheMemberThatIsWrong) {
    for (const auto& [text, message] : std::vector<std::pair<const char*, const char*>>{
             {"[]", "the text is no JSON object"},
             {R"({"lamps": {}})", "the text has a member 'lamps', which there is not"},
             {R"({"lights": []})", "'lights' of the text is not an object of edits by name"},
             {R"({"lights": {"lamp": 3}})", "lights 'lamp' is no JSON object"},
             {R"({"lights": {"lamp": {"colour": 3}}})", "lights 'lamp' has a member 'colour'"},
             {R"({"lights": {"lamp": {"position": [0, 1]}}})",
              "'position' of lights 'lamp' is not 3 numbers"},
             {R"({"lights": {"lamp": {"position": [0, 1, 1e300]}}})", "is not 3 numbers"},
             {R"({"lights": {"lamp": {"position": [0, "1", 2]}}})", "is not 3 numbers"},
             {R"({"lights": {"lamp": {"intensity": [0, -1, 2]}}})", "is not 3 numbers from 0"},
             {R"({"lights": {"lamp": {"direction": [0, 0, 0]}}})", "a direction, which is not 0"},
             {R"({"materials": {"0": {"roughness": 1.5}}})", "a number from 0 to 1"},
             {R"({"materials": {"0": {"ior": 0.5}}})", "a number from 1"},
             {R"({"nodes": {"a": {"rotation": [0, 0, 0, 0]}}})", "a quaternion"},
             {R"({"nodes": {"a": {"rotation": [0, 0, 1]}}})", "4 numbers"},
             {R"({"cameras": {"0": {"vertical_angle": 180}}})", "a number from 0.01 to 179"},
             {R"({"sun": {"elevation": 91}})", "'elevation' of sun is not a number from -90 to 90"},
             {R"({"sun": {"height": 1}})", "sun has a member 'height'"}}) {
        const std::string error = error_of([&, text = text] { edits_of(text); });
        EXPECT_THAT(error, HasSubstr("reading edits 'e.json': "));
        EXPECT_THAT(error, HasSubstr(message)) << text;
    }
}

TEST(Edits, ReplaceWhatTheyNameAndNothingElse) {
    Scene scene = load(file(), {});
    SceneEditor editor(scene);
    const Scene before = scene;
    editor.apply(edits_of(R"({
        "lights": {"lamp": {"position": [1, 2, 3], "direction": [0, -2, 0]}},
        "materials": {"1": {"base_color": [0.5, 0.25, 0], "roughness": 0.5, "emission": [1, 2, 3]}},
        "cameras": {"eye": {"position": [3, 0, 0], "target": [0, 0, 0], "vertical_angle": 60}}})"),
                 scene);
    const Light& light = scene.lights.at(0);
    EXPECT_EQ(light.position, glm::vec3(1, 2, 3));
    EXPECT_EQ(light.direction, glm::vec3(0, -1, 0));
    EXPECT_EQ(light.intensity, before.lights[0].intensity);
    EXPECT_EQ(light.outer_cone_angle, before.lights[0].outer_cone_angle);
    EXPECT_EQ(scene.materials[1].base_color, glm::vec3(0.5f, 0.25f, 0));
    EXPECT_EQ(scene.materials[1].roughness, 0.5f);
    EXPECT_EQ(scene.materials[1].emission, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.materials[1].metallic, before.materials[1].metallic);
    EXPECT_EQ(scene.materials[0].base_color, before.materials[0].base_color);
    const Camera& camera = scene.cameras.at(0);
    EXPECT_EQ(camera.position, glm::vec3(3, 0, 0));
    expect_near(camera.forward, {-1, 0, 0});
    expect_near(camera.up, {0, 1, 0});
    expect_near(camera.right, {0, 0, -1});
    EXPECT_FLOAT_EQ(camera.vertical_angle, glm::radians(60.0f));
    EXPECT_EQ(scene.positions, before.positions);
    // And they are taken back.
    editor.apply({}, scene);
    EXPECT_EQ(scene.lights, before.lights);
    EXPECT_EQ(scene.cameras, before.cameras);
    EXPECT_EQ(scene.materials[1].base_color, before.materials[1].base_color);
    EXPECT_EQ(scene.materials[1].emission, glm::vec3(0));
    EXPECT_EQ(scene.motion.lights.size(), before.motion.lights.size());
}

TEST(Edits, OfWhatMovesStayAtAllTimes) {
    Scene scene = load(file(), 0.5);
    EXPECT_EQ(scene.lights.at(0).position, glm::vec3(0.5f, 0, 0));
    SceneEditor editor(scene);
    const Edits edits = edits_of(R"({"lights": {"lamp": {"intensity": [7, 7, 7]}},
                                     "nodes": {"body": {"translation": [0, 4, 0]}}})");
    EXPECT_THAT(error_of([&] { editor.apply(edits, scene); }),
                HasSubstr("node 'body' cannot be moved"));
    editor.apply({}, scene);
    EXPECT_EQ(scene.lights.at(0).position, glm::vec3(0.5f, 0, 0));

    scene = load(file(), 0.5, true);
    const glm::vec3 corner = scene.positions.at(0) - glm::vec3(0.5f, 0, 0);
    SceneEditor(scene).apply(edits, scene);
    for (const std::optional<double> seconds : {std::optional(0.5), std::optional(1.0), {}}) {
        move_to(seconds, scene);
        // A light that is edited rests, whatever was edited.
        EXPECT_EQ(scene.lights.at(0).position, glm::vec3(0));
        EXPECT_EQ(scene.lights.at(0).intensity, glm::vec3(7));
        EXPECT_EQ(scene.positions.at(0), corner + glm::vec3(0, 4, 0));
    }
}

TEST(Edits, MoveWhatANodeCarries) {
    Animated parent = file();
    json& root = parent.builder.root;
    root["animations"].clear();
    root.erase("animations");
    root["nodes"][0]["children"] = {1};
    root["scenes"][0]["nodes"] = {0, 2};
    EXPECT_TRUE(load(parent, {}).motion.nodes.empty());
    Scene scene = load(parent, {}, true);
    const glm::vec3 corner = scene.positions.at(0), other = scene.positions.at(1);
    // A quarter of a turn about z.
    SceneEditor(scene).apply(edits_of(R"({"nodes": {"0": {"translation": [1, 2, 3],
        "rotation": [0, 0, 1, 1], "scale": [2, 2, 2]}}})"),
                             scene);
    move_to({}, scene);
    const auto moved = [](const glm::vec3& p) {
        return glm::vec3(1, 2, 3) + 2.0f * glm::vec3(-p.y, p.x, p.z);
    };
    expect_near(scene.positions.at(0), moved(corner));
    expect_near(scene.positions.at(1), moved(other));
    expect_near(scene.lights.at(0).position, glm::vec3(1, 2, 3));
}

TEST(Edits, OfANodeWithAMatrixMoveIt) {
    Animated with_matrix = file();
    json& root = with_matrix.builder.root;
    root.erase("animations");
    root["nodes"][0].erase("translation");
    root["nodes"][0]["matrix"] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 1, 1, 1};
    Scene scene = load(with_matrix, {}, true);
    const glm::vec3 corner = scene.positions.at(0);
    SceneEditor editor(scene);
    editor.apply(edits_of(R"({"nodes": {"body": {"translation": [1, 1, 5]}}})"), scene);
    move_to({}, scene);
    EXPECT_EQ(scene.positions.at(0), corner + glm::vec3(0, 0, 4));
    EXPECT_THAT(error_of([&] {
                    editor.apply(edits_of(R"({"nodes": {"body": {"scale": [1, 1, 1]}}})"), scene);
                }),
                HasSubstr("node 'body' has a matrix"));
}

TEST(Edits, OfWhatThereIsNotAreErrors) {
    Scene scene = load(file(), {}, true);
    SceneEditor editor(scene);
    for (const auto& [text, message] : std::vector<std::pair<const char*, const char*>>{
             {R"({"lights": {"moon": {}}})", "there is no light of the name or index 'moon'"},
             {R"({"lights": {"1": {}}})", "there is no light of the name or index '1'"},
             {R"({"materials": {"gold": {}}})", "there is no material"},
             {R"({"cameras": {"7": {}}})", "there is no camera"},
             {R"({"nodes": {"head": {}}})", "there is no node of the name or index 'head'"},
             {R"({"cameras": {"0": {"target": [0, 0, 5]}}})", "camera 'eye' has no direction"},
             {R"({"cameras": {"0": {"target": [0, 9, 5]}}})", "along its own 'up'"}}) {
        EXPECT_THAT(error_of([&, text = text] { editor.apply(edits_of(text), scene); }),
                    HasSubstr(message))
            << text;
    }
}

TEST(Edits, OfTheSunReplaceTheSky) {
    Scene scene = load(file(), {});
    SceneEditor editor(scene);
    EXPECT_FALSE(scene.environment);
    editor.apply(edits_of(R"({"sun": {"elevation": 90}})"), scene);
    ASSERT_TRUE(scene.environment && scene.environment->sun);
    expect_near(scene.environment->sun->towards, {0, 1, 0});
    const auto picture = scene.environment->picture;
    editor.apply(edits_of(R"({"sun": {"elevation": 90}, "lights": {"lamp": {}}})"), scene);
    EXPECT_EQ(scene.environment->picture, picture) << "it is made again";
    editor.apply({}, scene);
    EXPECT_FALSE(scene.environment);
}

TEST(Edits, OfMaterialsMakeSolids) {
    Animated thick = file();
    json& paint = thick.builder.root["materials"][0]["extensions"];
    paint["KHR_materials_volume"]["thicknessFactor"] = 1;
    paint["KHR_materials_transmission"]["transmissionFactor"] = 1; // of which metal has none
    Scene scene = load(thick, {}, true);
    SceneEditor editor(scene);
    EXPECT_TRUE(scene.solids.value().materials.empty());
    // Whatever moves at the same time, and whichever way it faces.
    for (
        const char* edits :
        {R"({"materials": {"paint": {"metallic": 0}}})",
         R"({"materials": {"paint": {"metallic": 0}}, "nodes": {"body": {"scale": [-1, 1, 1]}}})"}) {
        editor.apply(edits_of(edits), scene);
        EXPECT_EQ(scene.solids.value().materials, std::vector<std::uint32_t>{0});
        EXPECT_EQ(scene.solids.value().of_material[0], 1u);
    }
    editor.apply(edits_of(R"({"materials": {"paint": {"metallic": 0, "transmission": 0}}})"),
                 scene);
    EXPECT_TRUE(scene.solids.value().materials.empty());
    editor.apply({}, scene);
    EXPECT_TRUE(scene.solids.value().materials.empty());
}

TEST(Edits, OfANodeThatMirrorsTurnTriangles) {
    Scene scene = load(file(), {}, true);
    const std::vector<glm::uvec3> before = scene.triangles;
    SceneEditor editor(scene);
    editor.apply(edits_of(R"({"nodes": {"body": {"scale": [1, -1, 1]}}})"), scene);
    EXPECT_EQ(scene.triangles.at(0), glm::uvec3(before[0].x, before[0].z, before[0].y));
    editor.apply({}, scene);
    EXPECT_EQ(scene.triangles, before);
}

TEST(Edits, LeaveUnlitMaterialsDark) {
    Animated unlit = file();
    unlit.builder.root["materials"][0]["extensions"]["KHR_materials_unlit"] = json::object();
    Scene scene = load(unlit, {});
    SceneEditor(scene).apply(edits_of(R"({"materials": {"paint": {"emission": [1, 1, 1]}}})"),
                             scene);
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(0));
}

} // namespace
} // namespace argand
