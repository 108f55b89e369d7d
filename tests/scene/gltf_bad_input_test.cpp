#include "gltf_builder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

// References, sizes and types that do not fit. Each must cause a one-line message that names the
// fault.

namespace argand {
namespace {

using namespace testing_gltf;
using ::testing::HasSubstr;

/// A square of two indexed triangles with normals: mesh 0, accessors 0 (positions), 1 (normals), 2
/// (indices).
GltfBuilder square() {
    GltfBuilder builder;
    const int positions = builder.add_vectors({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const int normals = builder.add_vectors(std::vector<glm::vec3>(4, {0, 0, 1}));
    const int indices = builder.add_indices<std::uint16_t>({0, 1, 2, 0, 2, 3});
    builder.add_node(
        {{"mesh", builder.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                                    {"indices", indices}})}});
    return builder;
}

/// The message for loading the square with the value at `pointer` replaced.
std::string problem_with(const std::string& pointer, const json& value) {
    GltfBuilder builder = square();
    builder.root[json::json_pointer(pointer)] = value;
    const std::string problem = builder.problem();
    EXPECT_EQ(problem.find('\n'), std::string::npos);
    if (!problem.empty()) {
        EXPECT_THAT(problem, HasSubstr("scene.glb"));
    }
    return problem;
}

TEST(GltfBadInput, UnmodifiedSquareLoads) { EXPECT_EQ(square().problem(), ""); }

TEST(GltfBadInput, IndicesOutOfRange) {
    GltfBuilder builder = square();
    const std::size_t offset = builder.root["bufferViews"][2]["byteOffset"];
    builder.binary[offset] = 4;
    EXPECT_THAT(builder.problem(), HasSubstr("mesh 0 has index 4, but only 4 vertices"));
    builder.binary[offset] = 0xff; // primitive restart, which glTF does not support
    builder.binary[offset + 1] = 0xff;
    EXPECT_THAT(builder.problem(), HasSubstr("mesh 0 has index 65535"));
}

TEST(GltfBadInput, ReferencesToMissingObjects) {
    EXPECT_THAT(problem_with("/nodes/0/mesh", 3),
                HasSubstr("node 0 refers to mesh 3, which does not exist"));
    EXPECT_THAT(problem_with("/meshes/0/primitives/0/material", 0),
                HasSubstr("material 0, which does not exist"));
    EXPECT_THAT(problem_with("/meshes/0/primitives/0/attributes/POSITION", 9),
                HasSubstr("accessor 9, which does not exist"));
    EXPECT_THAT(problem_with("/meshes/0/primitives/0/attributes/NORMAL", 9),
                HasSubstr("accessor 9, which does not exist"));
    EXPECT_THAT(problem_with("/meshes/0/primitives/0/indices", 9), HasSubstr("indices"));
    EXPECT_THAT(problem_with("/accessors/0/bufferView", 9),
                HasSubstr("buffer view 9, which does not exist"));
    EXPECT_THAT(problem_with("/bufferViews/0/buffer", 9),
                HasSubstr("buffer 9, which does not exist"));
    EXPECT_THAT(problem_with("/scenes/0/nodes/0", 9), HasSubstr("node 9, which does not exist"));
}

TEST(GltfBadInput, MalformedIndices) {
    for (const char* pointer :
         {"/nodes/0/mesh", "/meshes/0/primitives/0/material", "/meshes/0/primitives/0/indices",
          "/meshes/0/primitives/0/attributes/POSITION", "/accessors/0/bufferView",
          "/bufferViews/0/buffer", "/scenes/0/nodes/0", "/scene", "/meshes/0/primitives/0/mode"}) {
        for (const json& value :
             {json(-1), json(0.5), json("0"), json(nullptr), json(4294967296), json(true)}) {
            EXPECT_THAT(problem_with(pointer, value),
                        HasSubstr("must be an integer from 0 to 2147483647"))
                << pointer << " = " << value;
        }
    }
    EXPECT_THAT(problem_with("/nodes/0/children", json{0.5}),
                HasSubstr("\"children\" must be an integer"));
}

TEST(GltfBadInput, MalformedSizes) {
    for (const char* pointer :
         {"/accessors/0/count", "/accessors/0/byteOffset", "/bufferViews/0/byteOffset",
          "/bufferViews/0/byteLength", "/bufferViews/0/byteStride"}) {
        for (const json& value :
             {json(-4), json(0.5), json("8"), json(1e300), json(18446744073709551615u)}) {
            EXPECT_THAT(problem_with(pointer, value), HasSubstr("must be an integer from 0"))
                << pointer << " = " << value;
        }
    }
}

TEST(GltfBadInput, AccessorsOutOfBounds) {
    EXPECT_THAT(
        problem_with("/accessors/0/count", 5),
        HasSubstr(
            "the positions of mesh 0 (5 elements, 12 bytes apart, at 0) go past the 48 bytes"));
    EXPECT_THAT(problem_with("/accessors/0/byteOffset", 4), HasSubstr("go past"));
    EXPECT_THAT(problem_with("/accessors/0/byteOffset", 1ull << 50), HasSubstr("go past"));
    EXPECT_THAT(problem_with("/accessors/0/count", 1ull << 53), HasSubstr("go past"));
    EXPECT_THAT(problem_with("/accessors/2/count", 7), HasSubstr("go past"));
    EXPECT_THAT(problem_with("/accessors/2/count", 1ull << 53),
                HasSubstr("more than 134217728 triangles"));
    EXPECT_THAT(problem_with("/accessors/2/byteOffset", 2), HasSubstr("the indices of mesh 0"));
}

TEST(GltfBadInput, BufferViewsOutOfBounds) {
    EXPECT_THAT(problem_with("/bufferViews/0/byteLength", 100000),
                HasSubstr("buffer view 0 (100000 bytes at 0) goes past"));
    EXPECT_THAT(problem_with("/bufferViews/0/byteOffset", 100000), HasSubstr("goes past"));
    EXPECT_THAT(problem_with("/bufferViews/0/byteOffset", 1ull << 53), HasSubstr("goes past"));
    EXPECT_THAT(problem_with("/bufferViews/0/byteStride", 8),
                HasSubstr("12 bytes each, but buffer view 0 puts them 8 bytes apart"));
    EXPECT_THAT(problem_with("/bufferViews/0/byteStride", 7), HasSubstr("byteStride"));
    EXPECT_THAT(problem_with("/bufferViews/0/byteStride", 24), HasSubstr("go past"));
}

TEST(GltfBadInput, BuffersShorterThanStated) {
    GltfBuilder builder = square();
    builder.root["buffers"] = {{{"byteLength", 1000}}};
    const TempDirectory directory;
    const auto file = directory.write("scene.glb", make_glb(builder.root.dump(), builder.binary));
    EXPECT_THROW(load_gltf(file), Error);
}

TEST(GltfBadInput, WrongTypes) {
    EXPECT_THAT(problem_with("/accessors/0/type", "VEC2"),
                HasSubstr("positions of mesh 0 are not three-component"));
    EXPECT_THAT(problem_with("/accessors/1/type", "SCALAR"),
                HasSubstr("normals of mesh 0 are not three-component"));
    EXPECT_THAT(problem_with("/accessors/0/type", "MAT3"), HasSubstr("does not allow there"));
    EXPECT_THAT(problem_with("/accessors/0/type", "VEC9"), HasSubstr("Unsupported `type`"));
    EXPECT_THAT(problem_with("/accessors/0/componentType", uint_type),
                HasSubstr("not three-component vectors of a type"));
    EXPECT_THAT(problem_with("/accessors/0/componentType", 5130),
                HasSubstr("component type (5130)")); // double
    EXPECT_THAT(problem_with("/accessors/0/componentType", 5124),
                HasSubstr("component type (5124)")); // signed int
    EXPECT_THAT(problem_with("/accessors/0/componentType", 1), HasSubstr("componentType"));
    EXPECT_THAT(problem_with("/accessors/2/componentType", short_type),
                HasSubstr("indices of mesh 0 are not unsigned"));
    EXPECT_THAT(problem_with("/accessors/2/type", "VEC2"), HasSubstr("indices of mesh 0"));
    EXPECT_THAT(problem_with("/meshes/0/primitives/0/mode", 7), HasSubstr("mode 7"));
    EXPECT_THAT(problem_with("/accessors/1/count", 3), HasSubstr("4 positions but 3 normals"));
}

TEST(GltfBadInput, WrongJsonTypesEverywhere) {
    // With any value in any place, the file either loads or fails with an Error.
    GltfBuilder builder = square();
    builder.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}}},
                                  {"extensions", {{"KHR_materials_ior", {{"ior", 1.5}}}}}}};
    builder.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    builder.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", {{"outerConeAngle", 1}}}}};
    builder.root["nodes"][0]["camera"] = 0;
    builder.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    builder.root["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", 2}, {"componentType", ushort_type}}},
        {"values", {{"bufferView", 0}}}};
    builder.root["images"] = {{{"bufferView", 0}, {"mimeType", "image/png"}}};
    const int times = builder.add_accessor(builder.add_view(std::vector<float>{0, 1, 2, 3}),
                                           float_type, "SCALAR", 4);
    builder.root["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}},
         {"samplers", {{{"input", times}, {"output", 0}}}}}};
    builder.root["skins"] = {{{"joints", {0}}}};
    builder.root["buffers"] = {{{"byteLength", builder.binary.size()}}};
    EXPECT_EQ(builder.problem(), "");
    const json good = builder.root;
    int loaded = 0;
    int refused = 0;
    const TempDirectory directory;
    const json flat = good.flatten();
    for (const auto& [pointer, unused] : flat.items()) {
        for (json::json_pointer at(pointer); !at.empty(); at.pop_back()) {
            for (const json& value :
                 {json(nullptr), json(-1), json(1), json(4e9), json("text"), json(true),
                  json::array(), json::object(), json{json::array()}, json{{"a", 1}}}) {
                json bad = good;
                bad[at] = value;
                const auto file =
                    directory.write("scene.glb", make_glb(bad.dump(), builder.binary));
                try {
                    load_gltf(file);
                    ++loaded;
                } catch (const Error& error) {
                    ++refused;
                    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos)
                        << error.what();
                }
            }
        }
    }
    EXPECT_GT(refused, 500);
    EXPECT_GT(loaded, 50);
}

TEST(GltfBadInput, NumbersThatAreNotFinite) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
          -std::numeric_limits<float>::infinity()}) {
        GltfBuilder builder;
        builder.add_triangles({{0, 0, 0}, {1, 0, 0}, {0, bad, 0}});
        builder.root["meshes"][0]["name"] = "dragon";
        EXPECT_THAT(builder.problem(),
                    HasSubstr("vertex 2 of mesh 0 \"dragon\" has a position that is not finite"));

        builder = GltfBuilder();
        const int positions = builder.add_vectors(right_triangle());
        const int normals = builder.add_vectors({{0, 0, 1}, {bad, 0, 1}, {0, 0, 1}});
        builder.add_node(
            {{"mesh",
              builder.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}})}});
        EXPECT_THAT(builder.problem(),
                    HasSubstr("vertex 1 of mesh 0 has a normal that is not finite"));
    }
}

TEST(GltfBadInput, SparseAccessors) {
    const auto problem = [](const std::vector<std::uint8_t>& indices, const json& patch) {
        GltfBuilder builder = square();
        const int view = builder.add_view(indices);
        const int values = builder.add_view(std::vector<glm::vec3>(2, glm::vec3(1, 2, 3)));
        builder.root["accessors"][0]["sparse"] = {
            {"count", 2},
            {"indices", {{"bufferView", view}, {"componentType", ubyte_type}}},
            {"values", {{"bufferView", values}}}};
        builder.root["accessors"][0]["sparse"].merge_patch(patch);
        return builder.problem();
    };
    EXPECT_EQ(problem({0, 3}, json::object()), "");
    EXPECT_THAT(problem({0, 4}, json::object()), HasSubstr("do not increase from 0 to below 4"));
    EXPECT_THAT(problem({3, 0}, json::object()), HasSubstr("do not increase"));
    EXPECT_THAT(problem({1, 1}, json::object()), HasSubstr("do not increase"));
    EXPECT_THAT(problem({0, 3}, {{"count", 5}}), HasSubstr("replace 5 of 4 elements"));
    EXPECT_THAT(problem({0, 3}, {{"count", 3}}), HasSubstr("go past"));
    EXPECT_THAT(problem({0, 3}, {{"count", -1}}), HasSubstr("\"count\" must be an integer"));
    EXPECT_THAT(problem({0, 3}, {{"count", 4294967297}}),
                HasSubstr("\"count\" must be an integer"));
    EXPECT_THAT(problem({0, 3}, {{"indices", {{"byteOffset", 1}}}}), HasSubstr("go past"));
    EXPECT_THAT(problem({0, 3}, {{"indices", {{"byteOffset", -1}}}}),
                HasSubstr("\"byteOffset\" must be an integer"));
    EXPECT_THAT(problem({0, 3}, {{"values", {{"byteOffset", 4294967296}}}}),
                HasSubstr("\"byteOffset\" must be an integer"));
    EXPECT_THAT(problem({0, 3}, {{"values", {{"bufferView", 77}}}}), HasSubstr("buffer view 77"));
    EXPECT_THAT(problem({0, 3}, {{"indices", {{"componentType", float_type}}}}),
                HasSubstr("not an unsigned integer"));
}

TEST(GltfBadInput, NothingToRender) {
    GltfBuilder builder;
    EXPECT_THAT(builder.problem(), HasSubstr("nothing to render"));
    builder.add_node({{"name", "empty"}});
    EXPECT_THAT(builder.problem(), HasSubstr("nothing to render"));
    builder.add_triangles(std::vector<glm::vec3>(6, {1, 2, 3}));
    EXPECT_THAT(builder.problem(), HasSubstr("nothing to render"));
    EXPECT_THAT(problem_with("/accessors/2/count", 0), HasSubstr("nothing to render"));
    EXPECT_THAT(problem_with("/meshes/0/primitives", json::array()),
                HasSubstr("nothing to render"));
}

TEST(GltfBadInput, SmallFilesCannotRequestHugeMemory) {
    // An accessor without data is all zeros, of any count.
    GltfBuilder builder;
    builder.root["accessors"] = {
        {{"componentType", float_type}, {"type", "VEC3"}, {"count", 1ull << 52}}};
    builder.add_node({{"mesh", builder.add_mesh({{"attributes", {{"POSITION", 0}}}})}});
    EXPECT_THAT(builder.problem(), HasSubstr("more than 134217728 triangles"));
    builder.root["accessors"][0]["count"] = 1 << 23;
    EXPECT_THAT(builder.problem(), HasSubstr("8388608 elements without data; at most"));
    // An allowed count, shown a thousand times.
    builder.root["accessors"][0]["count"] = 3 << 20;
    for (int i = 0; i < 1000; ++i) {
        builder.add_node({{"mesh", 0}});
    }
    builder.root["scenes"][0]["nodes"] = json::array();
    for (std::size_t i = 0; i < builder.root["nodes"].size(); ++i) {
        builder.root["scenes"][0]["nodes"].push_back(i);
    }
    EXPECT_THAT(builder.problem(), HasSubstr("its scene has more than 134217728 triangles"));
}

} // namespace
} // namespace argand
