// Skins and morph targets: against the formulas of glTF 2.0, in double precision.
#include "animated.hpp"
#include "scene/pose.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace argand {
namespace {

using namespace testing_gltf;
using ::testing::HasSubstr;

/// Numbers of a triangle mesh that joints carry.
struct Skinned {
    Animated file;
    std::vector<glm::vec3> positions, normals;
    std::vector<std::vector<std::uint8_t>> joints; ///< four for each vertex, by set
    std::vector<std::vector<float>> weights;
    std::vector<glm::mat4> joint_from_mesh;

    /// Adds the mesh with a skin of these nodes. Returns its node.
    int add(const std::vector<int>& joint_nodes, json node = json::object()) {
        GltfBuilder& b = file.builder;
        json attributes{{"POSITION", b.add_vectors(positions)}, {"NORMAL", b.add_vectors(normals)}};
        for (std::size_t i = 0; i < joints.size(); ++i) {
            const std::string set = std::to_string(i);
            attributes["JOINTS_" + set] =
                b.add_accessor(b.add_view(joints[i]), ubyte_type, "VEC4", joints[i].size() / 4);
            attributes["WEIGHTS_" + set] =
                file.add_floats(weights[i], "VEC4", weights[i].size() / 4);
        }
        json skin{{"joints", joint_nodes}};
        if (!joint_from_mesh.empty()) {
            skin["inverseBindMatrices"] = b.add_accessor(b.add_view(joint_from_mesh), float_type,
                                                         "MAT4", joint_from_mesh.size());
        }
        node["mesh"] = b.add_mesh({{"attributes", attributes}});
        node["skin"] = GltfBuilder::append(b.root["skins"], skin);
        return b.add_node(node);
    }
};

/// An arm along x whose forearm turns about z at x = 1: a strip of two triangles, the right half
/// carried by the second joint.
Skinned arm() {
    Skinned s;
    s.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
    s.normals.assign(6, {0, 0, 1});
    s.joints = {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}};
    s.weights = {{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, .5f, .5f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}};
    glm::mat4 back(1);
    back[3] = glm::vec4(-1, 0, 0, 1);
    s.joint_from_mesh = {glm::mat4(1), back};
    const int upper = s.file.builder.add_node({{"children", {1}}});
    s.file.builder.root["nodes"].push_back({{"translation", {1, 0, 0}}});
    // The mesh's node has a transform that must not count.
    s.add({upper, upper + 1}, {{"translation", {50, 50, 50}}});
    return s;
}

TEST(Skin, JointsCarryVertices) {
    Skinned s = arm();
    EXPECT_EQ(s.file.load({}).positions, s.positions);
    EXPECT_TRUE(s.file.load({}).motion.meshes.empty());
    const float half = std::sqrt(0.5f);
    const int times = s.file.add_floats({0, 1}, "SCALAR", 2);
    const int values = s.file.add_floats({0, 0, 0, 1, 0, 0, half, half}, "VEC4", 2);
    s.file.builder.root["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}}}},
         {"samplers", {{{"input", times}, {"output", values}}}}}};
    const Scene bent = s.file.load(1.0);
    EXPECT_EQ(bent.positions[1], glm::vec3(1, 0, 0));
    expect_near(bent.positions[3], {1, 0, 0}); // at the elbow, wherever it belongs
    expect_near(bent.positions[4], {1, 1, 0});
    expect_near(bent.positions[5], {0, 0, 0});
    const double r = std::sqrt(0.5);
    expect_near(s.file.load(0.5).positions[4], {1 + r, r, 0});
    EXPECT_EQ(bent.motion.meshes.size(), 1u);
}

TEST(Skin, AgreesWithTheFormulaForRandomSkeletons) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> number(-1, 1);
    Skinned s;
    constexpr std::size_t bones = 7, vertices = 33;
    std::vector<int> nodes;
    for (std::size_t i = 0; i < bones; ++i) {
        nodes.push_back(static_cast<int>(i));
        glm::mat4 inverse(1);
        for (int k = 0; k < 12; ++k) {
            inverse[k / 3][k % 3] = number(random);
        }
        s.joint_from_mesh.push_back(inverse);
        json node{{"translation", {number(random), number(random), number(random)}},
                  {"scale", {number(random), number(random), 1}}};
        i == 0 ? void(s.file.builder.add_node(node)) : s.file.builder.root["nodes"].push_back(node);
        if (i > 0) {
            s.file.builder.root["nodes"][i / 2]["children"].push_back(i);
        }
    }
    s.joints.resize(2);
    s.weights.resize(2);
    for (std::size_t v = 0; v < vertices; ++v) {
        s.positions.emplace_back(number(random), number(random), number(random));
        s.normals.emplace_back(0, 1, 0);
        float weights[4];
        float sum = 0;
        for (float& w : weights) {
            w = std::abs(number(random));
            sum += w;
        }
        // Every other vertex has two joints in each set, else four in the first.
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t set = v % 2 == 0 ? k / 2 : 0;
            for (std::size_t other = 0; other < 2; ++other) {
                s.joints[other].push_back(static_cast<std::uint8_t>((v + 2 * k) % bones));
                s.weights[other].push_back(set == other ? weights[k] / sum : 0.0f);
            }
        }
    }
    s.add(nodes);
    const Scene scene = s.file.load({});
    ASSERT_EQ(scene.positions.size(), vertices);
    // Oracle: world transforms by recursion, then the sum over joints of both sets.
    const auto world = [&](auto self, std::size_t node) -> glm::dmat4 {
        const json& n = s.file.builder.root["nodes"][node];
        glm::dmat4 local(1);
        for (int axis = 0; axis < 3; ++axis) {
            local[axis][axis] = n["scale"][std::size_t(axis)].get<double>();
            local[3][axis] = n["translation"][std::size_t(axis)].get<double>();
        }
        return node == 0 ? local : self(self, node / 2) * local;
    };
    for (std::size_t v = 0; v < vertices; ++v) {
        glm::dvec4 expected(0);
        for (std::size_t set = 0; set < 2; ++set) {
            for (std::size_t k = 0; k < 4; ++k) {
                const std::size_t joint = s.joints[set][4 * v + k];
                expected += double(s.weights[set][4 * v + k]) *
                            (world(world, joint) * (glm::dmat4(s.joint_from_mesh[joint]) *
                                                    glm::dvec4(s.positions[v], 1)));
            }
        }
        expect_near(scene.positions[v], glm::dvec3(expected), 1e-6);
        EXPECT_NEAR(glm::length(scene.normals[v]), 1, 1e-6);
    }
}

TEST(Skin, WeightsAreNormalisedWithANote) {
    Skinned s = arm();
    json& attributes = s.file.builder.root["meshes"][0]["primitives"][0]["attributes"];
    std::vector<float> twice = s.weights[0];
    for (float& w : twice) {
        w *= 2;
    }
    attributes["WEIGHTS_0"] = s.file.add_floats(twice, "VEC4", 6);
    const Scene scene = s.file.load({});
    EXPECT_EQ(scene.positions, s.positions);
    EXPECT_TRUE(has_note(scene, "do not sum to 1"));
    EXPECT_FALSE(has_note(arm().file.load({}), "do not sum to 1"));
}

TEST(Skin, WithoutMatricesJointsMoveVerticesAsTheyAre) {
    Skinned s = arm();
    s.file.builder.root["skins"][0].erase("inverseBindMatrices");
    const Scene scene = s.file.load({});
    EXPECT_EQ(scene.positions[4], glm::vec3(3, 0, 0)); // by the second joint, at x = 1
    EXPECT_FALSE(has_note(scene, "not quite valid"));
}

TEST(Skin, BadOnesAreErrors) {
    const auto with_weight = [](float weight) {
        Skinned s = arm();
        s.weights[0][0] = weight;
        s.file.builder.root["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] =
            s.file.add_floats(s.weights[0], "VEC4", 6);
        return s.file.builder.problem();
    };
    EXPECT_EQ(with_weight(1), "");
    EXPECT_THAT(with_weight(0), HasSubstr("vertex 0 of mesh 0 has joint weights that sum to 0"));
    EXPECT_THAT(with_weight(-1), HasSubstr("has a joint weight of -1"));
    EXPECT_THAT(with_weight(std::nanf("")), HasSubstr("has a joint weight of nan"));
    const auto with = [](const char* pointer, const json& value) {
        Skinned s = arm();
        s.file.builder.root[json::json_pointer(pointer)] = value;
        return s.file.builder.problem();
    };
    EXPECT_THAT(with("/nodes/2/skin", 4), HasSubstr("skin 4, which does not exist"));
    EXPECT_THAT(with("/skins/0/joints", {0}), HasSubstr("has joint 1, but its skin has 1"));
    EXPECT_THAT(with("/skins/0/joints", {0, 9}), HasSubstr("has node 9 as a joint"));
    EXPECT_THAT(with("/scenes/0/nodes", {2}), HasSubstr("which the scene does not have"));
    EXPECT_THAT(with("/nodes/1/children", {0}), HasSubstr("is reached twice"));
    EXPECT_THAT(with("/skins/0/inverseBindMatrices", 0), HasSubstr("are not 2 matrices"));
    EXPECT_THAT(with("/meshes/0/primitives/0/attributes/JOINTS_0", 0),
                HasSubstr("are not four small unsigned"));
    EXPECT_THAT(with("/accessors/2/count", 3), HasSubstr("has joints for 3 vertices"));
    EXPECT_THAT(with("/accessors/2/normalized", true), HasSubstr("are not four small unsigned"));
    EXPECT_THAT(with("/skins/0/inverseBindMatrices", 4294967296),
                HasSubstr("\"inverseBindMatrices\" must be an integer"));
    EXPECT_THAT(with("/skins/0/inverseBindMatrices", -1), HasSubstr("must be an integer"));
    EXPECT_THAT(with("/nodes/0/skin", -1), HasSubstr("must be an integer"));
}

/// A triangle with two morph targets: one lifts it, the other stretches it and turns its normals.
Animated morphed_triangle() {
    Animated file;
    GltfBuilder& b = file.builder;
    const json primitive{{"attributes",
                          {{"POSITION", b.add_vectors(right_triangle())},
                           {"NORMAL", b.add_vectors(std::vector<glm::vec3>(3, {0, 0, 1}))}}},
                         {"targets",
                          {{{"POSITION", b.add_vectors(std::vector<glm::vec3>(3, {0, 0, 4}))}},
                           {{"POSITION", b.add_vectors({{0, 0, 0}, {2, 0, 0}, {0, 0, 0}})},
                            {"NORMAL", b.add_vectors(std::vector<glm::vec3>(3, {1, 0, 0}))}}}}};
    b.add_node({{"mesh", b.add_mesh(primitive)}, {"scale", {1, 1, 0.5}}});
    return file;
}

void animate_weights(Animated& file, const std::vector<float>& times,
                     const std::vector<float>& values, const char* how = "LINEAR") {
    const int input = file.add_floats(times, "SCALAR", times.size());
    const int output = file.add_floats(values, "SCALAR", values.size());
    file.builder.root["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers", {{{"input", input}, {"output", output}, {"interpolation", how}}}}}};
}

TEST(Morph, TargetsAddByTheirWeights) {
    Animated file = morphed_triangle();
    EXPECT_EQ(corners_of(file.load({}), 0)[1], glm::vec3(1, 0, 0));
    file.builder.root["meshes"][0]["weights"] = {0.5, 1};
    expect_near(corners_of(file.load({}), 0)[1], {3, 0, 1});
    file.builder.root["nodes"][0]["weights"] = {0, -0.25}; // count instead of the mesh's
    const Scene scene = file.load({});
    expect_near(corners_of(scene, 0)[1], {0.5, 0, 0});
    // (-0.25, 0, 1) transformed by the inverse transpose of a scale of (1, 1, 1/2).
    expect_near(scene.normals[0], glm::normalize(glm::dvec3(-0.25, 0, 2)));
    EXPECT_TRUE(scene.motion.meshes.empty());
}

TEST(Morph, WeightsMoveInTime) {
    Animated file = morphed_triangle();
    animate_weights(file, {0, 2}, {0, 0, 1, 0.5f});
    expect_near(corners_of(file.load(1.0), 0)[1], {1.5, 0, 1});
    expect_near(corners_of(file.load(2.0), 0)[1], {2, 0, 2});
    EXPECT_EQ(corners_of(file.load({}), 0)[1], glm::vec3(1, 0, 0));
    animate_weights(file, {0, 2}, {9, 9, 0, 0, 0, 0, 0, 0, 1, 1, 9, 9}, "CUBICSPLINE");
    expect_near(corners_of(file.load(1.0), 0)[1], {2, 0, 1});
    EXPECT_EQ(file.load({}).animations[0].moves[0], "weights of node 0");
}

TEST(Morph, TogetherWithASkin) {
    Skinned s = arm();
    json& mesh = s.file.builder.root["meshes"][0];
    mesh["primitives"][0]["targets"] = {
        {{"POSITION", s.file.builder.add_vectors(std::vector<glm::vec3>(6, {0, 0, 1}))}}};
    mesh["weights"] = {2};
    s.file.builder.root["nodes"][1]["scale"] = {3, 3, 3};
    const Scene scene = s.file.load({});
    expect_near(scene.positions[0], {0, 0, 2});
    expect_near(scene.positions[4], {4, 0, 6}); // 1 + 3 (2 - 1)
}

TEST(Morph, BadOnesAreErrors) {
    const auto with = [](const char* pointer, const json& value) {
        Animated file = morphed_triangle();
        animate_weights(file, {0, 2}, {0, 0, 1, 1});
        file.builder.root[json::json_pointer(pointer)] = value;
        return file.builder.problem();
    };
    EXPECT_THAT(with("/meshes/0/weights", {1, 2, 3}), HasSubstr("3 morph weights for 2 targets"));
    EXPECT_THAT(with("/meshes/0/primitives/0/targets/0/POSITION", 99), HasSubstr("accessor 99"));
    EXPECT_THAT(with("/accessors/2/count", 2), HasSubstr("of morph target 0 of mesh 0 are 2"));
    EXPECT_THAT(with("/accessors/6/count", 3), HasSubstr("need 4 of 1"));
    EXPECT_THAT(with("/meshes/0/weights", {"a", 1}), HasSubstr("must be made of numbers"));
    EXPECT_THAT(with("/meshes/0/primitives/0/targets", json::array()),
                HasSubstr("moves the morph targets of node 0, which has none"));
}

// A few kilobytes must not ask for gigabytes.
TEST(Morph, ShortFilesCannotStateHugeOnes) {
    const auto zeros = [](Animated& file, const char* type, std::size_t count) {
        return GltfBuilder::append(
            file.builder.root["accessors"],
            {{"componentType", float_type}, {"type", type}, {"count", count}});
    };
    Animated weights = morphed_triangle();
    json& targets = weights.builder.root["meshes"][0]["primitives"][0]["targets"];
    targets = json::array();
    for (int i = 0; i < 1000; ++i) {
        targets.push_back(json::object());
    }
    for (int i = 0; i < 5000; ++i) {
        weights.builder.add_node({{"mesh", 0}});
    }
    EXPECT_THAT(weights.builder.problem(), HasSubstr("more than 4194304 morph weights"));

    Animated keys = morphed_triangle();
    keys.builder.root["meshes"][0]["primitives"][0]["targets"] = targets;
    const int times = zeros(keys, "SCALAR", 1);
    const int values = zeros(keys, "SCALAR", 3000);
    json animation{
        {"samplers", {{{"input", times}, {"output", values}, {"interpolation", "CUBICSPLINE"}}}}};
    for (int i = 0; i < 4000; ++i) {
        const int node = keys.builder.add_node({{"mesh", 0}});
        animation["channels"].push_back(
            {{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}});
    }
    keys.builder.root["animations"] = json::array({animation});
    EXPECT_THAT(keys.builder.problem(), HasSubstr("have more than 8388608 numbers"));

    Animated vectors = morphed_triangle();
    const std::size_t many = 1 << 20;
    json& primitive = vectors.builder.root["meshes"][0]["primitives"][0];
    primitive["attributes"] = {{"POSITION", zeros(vectors, "VEC3", many)}};
    primitive["targets"] = json::array();
    for (int i = 0; i < 17; ++i) {
        primitive["targets"].push_back({{"POSITION", primitive["attributes"]["POSITION"]}});
    }
    vectors.builder.root["meshes"][0]["weights"] = std::vector<double>(17, 1.0);
    EXPECT_THAT(vectors.builder.problem(), HasSubstr("more than 33554432 vectors"));
}

} // namespace
} // namespace argand
