#include "gltf_builder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace argand {
namespace {

using namespace testing_gltf;

TEST(GltfMesh, ReadsUnindexedTriangles) {
    const Scene scene = one_triangle().load();
    ASSERT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(corners_of(scene, 0), right_triangle());
    EXPECT_EQ(scene.normals, std::vector<glm::vec3>(3, glm::vec3(0))); // the file has none: flat
    EXPECT_DOUBLE_EQ(surface_area(scene), 0.5);
    EXPECT_EQ(scene.name, "scene.glb");
}

template <class Index> void expect_indexed_square() {
    GltfBuilder builder;
    const std::vector<glm::vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const int positions = builder.add_vectors(square);
    const int indices = builder.add_indices<Index>({0, 1, 2, 0, 2, 3});
    builder.add_node({{"mesh", builder.add_mesh({{"attributes", {{"POSITION", positions}}},
                                                 {"indices", indices}})}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.positions, square);
    EXPECT_THAT(scene.triangles, ::testing::ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)));
}

TEST(GltfMesh, ReadsIndicesOfEveryType) {
    expect_indexed_square<std::uint8_t>();
    expect_indexed_square<std::uint16_t>();
    expect_indexed_square<std::uint32_t>();
}

GltfBuilder with_mode(int mode, const std::vector<glm::vec3>& vertices) {
    GltfBuilder builder;
    const int positions = builder.add_vectors(vertices);
    builder.add_node(
        {{"mesh", builder.add_mesh({{"attributes", {{"POSITION", positions}}}, {"mode", mode}})}});
    return builder;
}

TEST(GltfMesh, ReadsStripsWithAlternatingWinding) {
    // A ribbon in z = 0; every triangle must face +z.
    const Scene scene =
        with_mode(strip, {{0, 1, 0}, {0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {2, 1, 0}, {2, 0, 0}}).load();
    ASSERT_EQ(scene.triangles.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        expect_near(winding_normal(scene, i), {0, 0, 1});
    }
    EXPECT_DOUBLE_EQ(surface_area(scene), 2);
}

TEST(GltfMesh, ReadsFans) {
    const Scene scene =
        with_mode(fan, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}}).load();
    ASSERT_EQ(scene.triangles.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        expect_near(winding_normal(scene, i), {0, 0, 1});
    }
    EXPECT_DOUBLE_EQ(surface_area(scene), 1.5);
}

TEST(GltfMesh, IgnoresPointsAndLinesWithANote) {
    for (const int mode : {points, 1, 2, line_strip}) {
        GltfBuilder builder = with_mode(mode, {{0, 0, 0}, {1, 0, 0}, {5, 5, 5}});
        EXPECT_THAT(builder.problem(), ::testing::HasSubstr("nothing to render"));
        builder.add_triangles(right_triangle());
        const Scene scene = builder.load();
        EXPECT_EQ(scene.triangles.size(), 1u);
        EXPECT_TRUE(has_note(scene, "points and lines are not rendered"));
    }
}

TEST(GltfMesh, IgnoresSurplusCornersWithANote) {
    const Scene scene = with_mode(triangles, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 7, 7}}).load();
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.positions.size(), 3u);
    EXPECT_TRUE(has_note(scene, "no multiple of three"));
    EXPECT_THAT(with_mode(strip, {{0, 0, 0}, {1, 0, 0}}).problem(),
                ::testing::HasSubstr("nothing to render"));
}

TEST(GltfMesh, DoesNotFollowIndicesOfSurplusCorners) {
    GltfBuilder builder = one_triangle();
    builder.root["meshes"][0]["primitives"][0]["indices"] =
        builder.add_indices(std::vector<std::uint32_t>{0, 1, 2, 4294967290u, 3});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_TRUE(has_note(scene, "no multiple of three"));
}

TEST(GltfMesh, ReadsNormalsAndMakesThemUnit) {
    GltfBuilder builder;
    const int positions = builder.add_vectors(right_triangle());
    const int normals = builder.add_vectors({{0, 0, 3}, {0, 0, 0}, {1e-30f, 0, 1e-30f}});
    builder.add_node(
        {{"mesh",
          builder.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}})}});
    const Scene scene = builder.load();
    expect_near(scene.normals[0], {0, 0, 1});
    EXPECT_EQ(scene.normals[1], glm::vec3(0)); // no direction: treated as absent
    expect_near(scene.normals[2], {std::sqrt(0.5), 0, std::sqrt(0.5)});
}

TEST(GltfMesh, ReadsInterleavedVertices) {
    GltfBuilder builder;
    std::vector<glm::vec3> interleaved;
    for (const glm::vec3& position : right_triangle()) {
        interleaved.push_back(position);
        interleaved.push_back({0, 1, 0});
    }
    const int view = builder.add_view(interleaved, 24);
    const int positions = builder.add_accessor(view, float_type, "VEC3", 3, 0);
    const int normals = builder.add_accessor(view, float_type, "VEC3", 3, 12);
    builder.add_node(
        {{"mesh",
          builder.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}})}});
    const Scene scene = builder.load();
    EXPECT_EQ(corners_of(scene, 0), right_triangle());
    EXPECT_EQ(scene.normals, std::vector<glm::vec3>(3, {0, 1, 0}));
}

/// One triangle whose positions are integers of type T, padded to four components.
template <class T>
Scene load_quantized(int component_type, bool normalized, const std::vector<T>& values) {
    GltfBuilder builder;
    const int positions =
        builder.add_accessor(builder.add_view(values, 4 * sizeof(T)), component_type, "VEC3", 3);
    builder.root["accessors"][std::size_t(positions)]["normalized"] = normalized;
    builder.root["extensionsUsed"] = {"KHR_mesh_quantization"};
    builder.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    builder.add_node({{"mesh", builder.add_mesh({{"attributes", {{"POSITION", positions}}}})}});
    return builder.load();
}

TEST(GltfMesh, ReadsIntegerPositionsOfEveryType) {
    const auto signed_byte =
        load_quantized<std::int8_t>(byte_type, false, {-128, 0, 0, 0, 127, 0, 0, 0, 0, 5, 0, 0});
    EXPECT_EQ(corners_of(signed_byte, 0),
              (std::vector<glm::vec3>{{-128, 0, 0}, {127, 0, 0}, {0, 5, 0}}));
    const auto byte =
        load_quantized<std::uint8_t>(ubyte_type, false, {0, 0, 0, 0, 255, 0, 0, 0, 0, 200, 0, 0});
    EXPECT_EQ(corners_of(byte, 0), (std::vector<glm::vec3>{{0, 0, 0}, {255, 0, 0}, {0, 200, 0}}));
    const auto signed_short = load_quantized<std::int16_t>(
        short_type, false, {-32768, 0, 0, 0, 32767, 0, 0, 0, 0, 5, 0, 0});
    EXPECT_EQ(corners_of(signed_short, 0),
              (std::vector<glm::vec3>{{-32768, 0, 0}, {32767, 0, 0}, {0, 5, 0}}));
    const auto unsigned_short =
        load_quantized<std::uint16_t>(ushort_type, false, {0, 0, 0, 0, 65535, 0, 0, 0, 0, 5, 0, 0});
    EXPECT_EQ(corners_of(unsigned_short, 0),
              (std::vector<glm::vec3>{{0, 0, 0}, {65535, 0, 0}, {0, 5, 0}}));
}

TEST(GltfMesh, ReadsNormalisedIntegers) {
    // glTF 2.0, section 3.11: c / 127 with −128 clamped to −1, and so on.
    const auto signed_byte = load_quantized<std::int8_t>(
        byte_type, true, {-128, 0, 0, 0, -127, 127, 0, 0, 127, 0, 0, 0});
    EXPECT_EQ(corners_of(signed_byte, 0),
              (std::vector<glm::vec3>{{-1, 0, 0}, {-1, 1, 0}, {1, 0, 0}}));
    const auto byte =
        load_quantized<std::uint8_t>(ubyte_type, true, {0, 0, 0, 0, 255, 0, 0, 0, 0, 51, 0, 0});
    EXPECT_EQ(corners_of(byte, 0), (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 0.2f, 0}}));
    const auto signed_short = load_quantized<std::int16_t>(
        short_type, true, {-32768, 0, 0, 0, 32767, 0, 0, 0, 0, -32767, 0, 0});
    EXPECT_EQ(corners_of(signed_short, 0),
              (std::vector<glm::vec3>{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}}));
    const auto unsigned_short = load_quantized<std::uint16_t>(
        ushort_type, true, {0, 0, 0, 0, 65535, 0, 0, 0, 0, 13107, 0, 0});
    EXPECT_EQ(corners_of(unsigned_short, 0),
              (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 0.2f, 0}}));
}

TEST(GltfMesh, ReadsSparseAccessors) {
    GltfBuilder builder;
    const int positions =
        builder.add_vectors({{0, 0, 0}, {1, 0, 0}, {9, 9, 9}, {0, 0, 7}, {1, 0, 7}, {9, 9, 9}});
    const int indices = builder.add_view(std::vector<std::uint16_t>{2, 5});
    const int values = builder.add_view(std::vector<glm::vec3>{{0, 1, 0}, {0, 1, 7}});
    builder.root["accessors"][std::size_t(positions)]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", indices}, {"componentType", ushort_type}}},
        {"values", {{"bufferView", values}}}};
    builder.add_node({{"mesh", builder.add_mesh({{"attributes", {{"POSITION", positions}}}})}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.triangles.size(), 2u);
    EXPECT_EQ(corners_of(scene, 0), right_triangle());
    EXPECT_EQ(corners_of(scene, 1), (std::vector<glm::vec3>{{0, 0, 7}, {1, 0, 7}, {0, 1, 7}}));
}

TEST(GltfMesh, ReadsSparseAccessorsOverZeros) {
    GltfBuilder builder;
    const int indices = builder.add_view(std::vector<std::uint8_t>{1, 2});
    const int values = builder.add_view(std::vector<glm::vec3>{{1, 0, 0}, {0, 1, 0}});
    builder.root["accessors"] = {
        {{"componentType", float_type},
         {"type", "VEC3"},
         {"count", 3},
         {"sparse",
          {{"count", 2},
           {"indices", {{"bufferView", indices}, {"componentType", ubyte_type}}},
           {"values", {{"bufferView", values}}}}}}};
    builder.add_node({{"mesh", builder.add_mesh({{"attributes", {{"POSITION", 0}}}})}});
    EXPECT_EQ(corners_of(builder.load(), 0), right_triangle());
}

TEST(GltfMesh, TakesOnlyTheVerticesThatTrianglesUse) {
    // Two primitives share one long vertex buffer; most of it is unused and not finite.
    GltfBuilder builder;
    std::vector<glm::vec3> vertices(1000, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    for (std::size_t i = 0; i < 3; ++i) {
        vertices[500 + i] = right_triangle()[i];
        vertices[700 + i] = right_triangle()[i] + glm::vec3(0, 0, 4);
    }
    const int positions = builder.add_vectors(vertices);
    const json attributes{{"POSITION", positions}};
    const int first = builder.add_indices<std::uint16_t>({500, 501, 502});
    const int second = builder.add_indices<std::uint16_t>({700, 701, 702});
    builder.add_node(
        {{"mesh", builder.add_mesh({{"attributes", attributes}, {"indices", first}})}});
    builder.root["meshes"][0]["primitives"].push_back(
        {{"attributes", attributes}, {"indices", second}});
    const Scene scene = builder.load();
    EXPECT_EQ(scene.positions.size(), 6u);
    EXPECT_EQ(corners_of(scene, 0), right_triangle());
    EXPECT_EQ(corners_of(scene, 1)[0], glm::vec3(0, 0, 4));
}

TEST(GltfMesh, LeavesOutTrianglesWithoutArea) {
    GltfBuilder builder;
    std::vector<glm::vec3> corners = right_triangle();
    for (const glm::vec3& collinear :
         {glm::vec3(0, 0, 0), glm::vec3(0.1f, 0.2f, 0.3f), glm::vec3(0.2f, 0.4f, 0.6f)}) {
        corners.push_back(collinear);
    }
    corners.insert(corners.end(), 3, glm::vec3(2, 2, 2));
    builder.add_triangles(corners);
    const Scene scene = builder.load();
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.triangle_material.size(), 1u);
    EXPECT_EQ(scene.positions.size(), 3u);
    EXPECT_TRUE(has_note(scene, "2 triangles without area are left out"));
}

TEST(GltfMesh, KeepsTinyAndHugeTriangles) {
    for (const float scale : {1e-30f, 1e-12f, 1e12f, 1e30f}) {
        GltfBuilder builder;
        builder.add_triangles({{0, 0, 0}, {scale, 0, 0}, {0, scale, 0}});
        const Scene scene = builder.load();
        EXPECT_EQ(scene.triangles.size(), 1u);
        EXPECT_DOUBLE_EQ(surface_area(scene), 0.5 * double(scale) * double(scale));
    }
}

TEST(GltfMesh, GivesPrimitivesWithoutMaterialTheDefaultOne) {
    GltfBuilder builder;
    builder.root["materials"] = {{{"name", "red"}}};
    builder.add_triangles(right_triangle());
    builder.add_triangles(right_triangle());
    builder.root["meshes"][0]["primitives"][0]["material"] = 0;
    const Scene scene = builder.load();
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_THAT(scene.triangle_material, ::testing::ElementsAre(0u, 1u));
    EXPECT_EQ(scene.materials[0].name, "red");
    EXPECT_EQ(scene.materials[1].name, "default");
    EXPECT_EQ(scene.materials[1].base_color, glm::vec3(1));
    EXPECT_EQ(scene.materials[1].metallic, 1);
    EXPECT_EQ(scene.materials[1].roughness, 1);
}

TEST(GltfMesh, NotesEachIgnoredFeatureOnce) {
    GltfBuilder builder;
    const int positions = builder.add_vectors(right_triangle());
    const json primitive{{"attributes", {{"POSITION", positions}, {"COLOR_1", positions}}}};
    const int mesh = builder.add_mesh(primitive);
    builder.add_mesh({{"attributes", {{"POSITION", positions}}}, {"mode", line_strip}});
    for (const int shown : {mesh, mesh, mesh + 1, mesh + 1}) {
        builder.add_node({{"mesh", shown}});
    }
    const Scene scene = builder.load();
    for (const char* what : {"vertex colours", "points and lines"}) {
        EXPECT_EQ(std::count_if(scene.notes.begin(), scene.notes.end(),
                                [&](const std::string& note) {
                                    return note.find(what) != std::string::npos;
                                }),
                  1)
            << what;
    }
}

} // namespace
} // namespace argand
