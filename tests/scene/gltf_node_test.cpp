#include "gltf_builder.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace testing_gltf;

const double half_root = std::sqrt(0.5);

/// The triangle with a normal along (1, 0, 1) under `node`'s transform.
Scene load_transformed(const json& node) {
    GltfBuilder builder;
    const int positions = builder.add_vectors(right_triangle());
    const int normals = builder.add_vectors(std::vector<glm::vec3>(3, {1, 0, 1}));
    json shown = node;
    shown["mesh"] =
        builder.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    builder.add_node(shown);
    return builder.load();
}

TEST(GltfNode, AppliesScaleThenRotationThenTranslation) {
    // Scale x by 2, rotate 90 degrees about z (x → y), translate.
    const Scene scene = load_transformed({{"scale", {2, 1, 1}},
                                          {"rotation", {0, 0, half_root, half_root}},
                                          {"translation", {10, 20, 30}}});
    const std::vector<glm::vec3> corners = corners_of(scene, 0);
    expect_near(corners[0], {10, 20, 30}, 1e-5);
    expect_near(corners[1], {10, 22, 30}, 1e-5);
    expect_near(corners[2], {9, 20, 30}, 1e-5);
    // Normals are transformed by the inverse transpose: (1, 0, 1) → (1/2, 0, 1) → (0, 1/2, 1).
    expect_near(scene.normals[0], glm::normalize(glm::dvec3(0, 0.5, 1)));
}

TEST(GltfNode, AppliesMatricesColumnsFirst) {
    const Scene scene =
        load_transformed({{"matrix", {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1}}});
    const std::vector<glm::vec3> corners = corners_of(scene, 0);
    EXPECT_EQ(corners, (std::vector<glm::vec3>{{10, 20, 30}, {10, 22, 30}, {9, 20, 30}}));
    expect_near(scene.normals[0], glm::normalize(glm::dvec3(0, 0.5, 1)));
}

TEST(GltfNode, NormalisesRotations) {
    const Scene scene = load_transformed({{"rotation", {0, 0, 3 * half_root, 3 * half_root}}});
    expect_near(corners_of(scene, 0)[1], {0, 1, 0});
}

TEST(GltfNode, AccumulatesParentsInDoublePrecision) {
    // Far away and back: single precision would lose the detail of 0.001.
    GltfBuilder builder;
    builder.add_triangles({{0, 0, 0}, {0.001f, 0, 0}, {0, 0.001f, 0}},
                          {{"translation", {-123456789, 0, 0}}});
    builder.root["nodes"].push_back({{"translation", {123456789, 5, 0}}, {"children", {0}}});
    builder.root["scenes"][0]["nodes"] = {1};
    expect_near(corners_of(builder.load(), 0)[1], {0.001, 5, 0}, 1e-8);
}

TEST(GltfNode, MirroringKeepsTheFrontInFront) {
    for (const json& scale :
         {json{-1, 1, 1}, json{1, -1, 1}, json{1, 1, -1}, json{-1, -1, -1}, json{-2, -3, 1}}) {
        const Scene scene = load_transformed({{"scale", scale}});
        // Before the transform, the normal (1, 0, 1) and the winding (0, 0, 1) are on the same
        // side; they must be so afterwards.
        EXPECT_GT(glm::dot(winding_normal(scene, 0), glm::dvec3(scene.normals[0])), 0)
            << "scale " << scale;
        const double z = scale[2].get<double>() < 0 ? -1 : 1;
        EXPECT_GT(winding_normal(scene, 0).z * z, 0) << "scale " << scale;
        EXPECT_GT(scene.normals[0].z * z, 0) << "scale " << scale;
    }
}

TEST(GltfNode, MirroringTwiceKeepsTheWinding) {
    GltfBuilder builder;
    builder.add_triangles(right_triangle(), {{"scale", {-1, 1, 1}}});
    builder.root["nodes"].push_back({{"scale", {1, -1, 1}}, {"children", {0}}});
    builder.root["scenes"][0]["nodes"] = {1};
    EXPECT_GT(winding_normal(builder.load(), 0).z, 0);
}

TEST(GltfNode, FlattenedMeshesKeepTheirNormals) {
    const Scene scene = load_transformed({{"scale", {1, 1, 0}}});
    expect_near(scene.normals[0], {0, 0, 1});
}

TEST(GltfNode, ExtremeScalesKeepNormals) {
    for (const double scale : {1e-20, 1e20}) {
        const Scene scene = load_transformed({{"scale", {scale, scale, scale}}});
        expect_near(scene.normals[0], {half_root, 0, half_root});
        EXPECT_EQ(scene.triangles.size(), 1u);
    }
}

TEST(GltfNode, InstancesAMeshForEveryNode) {
    GltfBuilder builder;
    builder.add_triangles(right_triangle());
    builder.add_node({{"mesh", 0}, {"translation", {0, 0, 1}}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.triangles.size(), 2u);
    EXPECT_EQ(corners_of(scene, 1)[0], glm::vec3(0, 0, 1));
}

/// Three nodes at z = 0, 1, 2, in scenes {0}, {1} and none.
GltfBuilder three_nodes() {
    GltfBuilder builder = one_triangle();
    for (int z : {1, 2}) {
        builder.root["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, z}}});
    }
    builder.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    builder.root.erase("scene");
    return builder;
}

TEST(GltfNode, ShowsTheDefaultSceneElseTheFirstElseAllRoots) {
    GltfBuilder builder = three_nodes();
    builder.root["scene"] = 1;
    Scene scene = builder.load();
    ASSERT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.positions[0].z, 1);

    builder.root.erase("scene");
    scene = builder.load();
    ASSERT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.positions[0].z, 0);

    builder.root.erase("scenes");
    builder.root["nodes"][0]["children"] = {1};
    scene = builder.load();
    EXPECT_EQ(scene.triangles.size(), 3u); // node 1 once, as a child

    builder.root["scenes"] = {{{"nodes", {0}}}};
    builder.root["scene"] = 7;
    EXPECT_THAT(builder.problem(), ::testing::HasSubstr("default scene 7 does not exist"));
}

TEST(GltfNode, RejectsCyclesAndSharedNodes) {
    GltfBuilder builder = three_nodes();
    builder.root["nodes"][0]["children"] = {1};
    builder.root["nodes"][1]["children"] = {0};
    EXPECT_THAT(builder.problem(), ::testing::HasSubstr("reached twice"));
    builder.root.erase("scenes"); // a cycle has no root
    EXPECT_EQ(builder.load().triangles.size(), 1u);

    builder = three_nodes();
    builder.root["nodes"][0]["children"] = {0};
    EXPECT_THAT(builder.problem(), ::testing::HasSubstr("reached twice"));

    builder = three_nodes();
    builder.root["nodes"][0]["children"] = {1, 2};
    builder.root["nodes"][1]["children"] = {2};
    EXPECT_THAT(builder.problem(), ::testing::HasSubstr("reached twice"));
}

TEST(GltfNode, RejectsExponentialSharingAtOnce) {
    // 40 levels, each referring to the next twice: 2^40 visits if nodes could be shared.
    GltfBuilder builder = one_triangle();
    for (int i = 1; i <= 40; ++i) {
        builder.root["nodes"].push_back({{"children", {i - 1, i - 1}}});
    }
    builder.root["scenes"][0]["nodes"] = {40};
    EXPECT_THAT(builder.problem(), ::testing::HasSubstr("reached twice"));
}

TEST(GltfNode, NestsDeeply) {
    GltfBuilder builder = one_triangle();
    const int depth = 20000;
    for (int i = 1; i <= depth; ++i) {
        builder.root["nodes"].push_back({{"children", {i - 1}}, {"translation", {0, 0, 1}}});
    }
    builder.root["scenes"][0]["nodes"] = nlohmann::json::array({depth});
    EXPECT_EQ(builder.load().positions[0].z, depth);
}

TEST(GltfNode, RejectsInvalidTransformsAndReferences) {
    const auto problem = [](const json& node) {
        GltfBuilder builder;
        builder.add_triangles(right_triangle(), node);
        return builder.problem();
    };
    using ::testing::HasSubstr;
    EXPECT_THAT(problem({{"matrix", {1, 2, 3}}}), HasSubstr("matrix that is not 16 numbers"));
    EXPECT_THAT(problem({{"translation", {1, 2}}}), HasSubstr("translation that is not 3 numbers"));
    EXPECT_THAT(problem({{"rotation", {0, 0, 0, 0}}}), HasSubstr("not a unit quaternion"));
    EXPECT_THAT(problem({{"scale", {1, "x", 1}}}), HasSubstr("\"scale\" must be made of numbers"));
    EXPECT_THAT(problem({{"scale", {1e300, 1e300, 1e300}}}),
                HasSubstr("not finite in world space"));
    EXPECT_THAT(problem({{"children", {99}}}), HasSubstr("node 99, which does not exist"));
    EXPECT_THAT(problem({{"children", {-1}}}), HasSubstr("\"children\" must be an integer"));
    EXPECT_THAT(problem({{"scale", {0, 0, 0}}}), HasSubstr("nothing to render"));
    EXPECT_THAT(problem({{"name", "broken\nnode"}, {"rotation", {0, 0, 0, 0}}}),
                HasSubstr("node 0 \"broken node\""));
}

} // namespace
} // namespace argand
