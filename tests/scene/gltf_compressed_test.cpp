// Compressed meshes, made by the libraries' own encoders, against the same meshes without
// compression.
#include "gltf_builder.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#ifdef ARGAND_HAVE_DRACO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#pragma GCC diagnostic pop
#endif
#ifdef ARGAND_HAVE_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace argand {
namespace {

using namespace testing_gltf;
using ::testing::HasSubstr;

/// A wavy grid of side × side vertices.
struct Grid {
    std::vector<glm::vec3> positions, normals;
    std::vector<std::uint32_t> indices;
};

Grid grid(std::uint32_t side) {
    Grid g;
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const float fx = static_cast<float>(x), fy = static_cast<float>(y);
            g.positions.emplace_back(fx, fy, std::sin(0.7f * fx + 0.3f * fy * fy));
            g.normals.push_back(glm::normalize(glm::vec3(0.1f * fx, -0.2f, 1)));
            if (x > 0 && y > 0) {
                const std::uint32_t i = y * side + x;
                g.indices.insert(g.indices.end(),
                                 {i - side - 1, i - side, i, i - side - 1, i, i - 1});
            }
        }
    }
    return g;
}

using Corner = std::array<float, 6>;
using Triangle = std::array<Corner, 3>;

/// Positions and normals of a scene's triangles, which are sorted, and begin with their least
/// corner: encoders may rotate triangles and change the order of triangles and vertices.
std::vector<Triangle> triangles_of(const Scene& scene) {
    std::vector<Triangle> all;
    for (const glm::uvec3& corners : scene.triangles) {
        Triangle t;
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 p = scene.positions[corners[k]], n = scene.normals[corners[k]];
            t[static_cast<std::size_t>(k)] = {p.x, p.y, p.z, n.x, n.y, n.z};
        }
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        all.push_back(t);
    }
    std::sort(all.begin(), all.end());
    return all;
}

Scene load_plain(const Grid& g) {
    GltfBuilder builder;
    const int positions = builder.add_vectors(g.positions),
              normals = builder.add_vectors(g.normals), indices = builder.add_indices(g.indices);
    builder.add_node(
        {{"mesh", builder.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                                    {"indices", indices}})}});
    return builder.load();
}

void expect_near_triangles(const std::vector<Triangle>& found,
                           const std::vector<Triangle>& expected, float tolerance) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t c = 0; c < 6; ++c) {
                ASSERT_NEAR(found[i][k][c], expected[i][k][c], tolerance) << i;
            }
        }
    }
}

/// Loads what may be damaged: it loads, or there is an error of one line, soon and in little
/// memory.
void expect_scene_or_error(const GltfBuilder& builder) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(builder.problem().find('\n'), std::string::npos);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 2);
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    EXPECT_LT(use.ru_maxrss, 1 << 20); // KiB
}

GltfBuilder requiring(GltfBuilder builder, const char* extension) {
    builder.root["extensionsUsed"] = {extension};
    builder.root["extensionsRequired"] = {extension};
    return builder;
}

int without_data(GltfBuilder& builder, int type, const char* shape, std::size_t count) {
    return GltfBuilder::append(builder.root["accessors"],
                               {{"componentType", type}, {"type", shape}, {"count", count}});
}

constexpr const char* draco_name = "KHR_draco_mesh_compression";
constexpr const char* meshopt_name = "EXT_meshopt_compression";

#ifdef ARGAND_HAVE_DRACO

/// The grid as Draco's bytes. bits: of quantised positions and normals; 0: floats as they are.
Bytes draco_bytes(const Grid& g, int bits, bool edgebreaker) {
    draco::Mesh mesh;
    mesh.set_num_points(static_cast<std::uint32_t>(g.positions.size()));
    const auto add = [&](draco::GeometryAttribute::Type type, const std::vector<glm::vec3>& data) {
        draco::GeometryAttribute attribute;
        attribute.Init(type, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
        const int id = mesh.AddAttribute(attribute, true, mesh.num_points());
        for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
            mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &data[i].x);
        }
    };
    add(draco::GeometryAttribute::POSITION, g.positions);
    add(draco::GeometryAttribute::NORMAL, g.normals);
    for (std::size_t i = 0; i < g.indices.size(); i += 3) {
        mesh.AddFace({draco::PointIndex(g.indices[i]), draco::PointIndex(g.indices[i + 1]),
                      draco::PointIndex(g.indices[i + 2])});
    }
    draco::ExpertEncoder encoder(mesh);
    encoder.SetEncodingMethod(edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING
                                          : draco::MESH_SEQUENTIAL_ENCODING);
    if (bits > 0) {
        encoder.SetAttributeQuantization(0, bits);
        encoder.SetAttributeQuantization(1, bits);
    }
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

GltfBuilder with_draco(const Bytes& bytes, std::size_t vertices, std::size_t indices) {
    GltfBuilder builder;
    const int view = builder.add_view(bytes);
    const int positions = without_data(builder, float_type, "VEC3", vertices);
    const int normals = without_data(builder, float_type, "VEC3", vertices);
    const int corners = without_data(builder, ushort_type, "SCALAR", indices);
    builder.add_node(
        {{"mesh", builder.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                                    {"indices", corners},
                                    {"extensions",
                                     {{draco_name,
                                       {{"bufferView", view},
                                        {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}}}}}})}});
    return requiring(builder, draco_name);
}

TEST(GltfDraco, MeshesAreThoseWithoutCompression) {
    for (const std::uint32_t side : {2u, 3u, 37u}) {
        const Grid g = grid(side);
        const std::vector<Triangle> plain = triangles_of(load_plain(g));
        for (const bool edgebreaker : {false, true}) {
            const Scene exact =
                with_draco(draco_bytes(g, 0, edgebreaker), g.positions.size(), g.indices.size())
                    .load();
            expect_near_triangles(triangles_of(exact), plain, 1e-6f);
            EXPECT_FALSE(has_note(exact, draco_name));
        }
    }
    // Coordinates on a grid of 2^20 steps do not change the order of triangles here.
    const Grid g = grid(9);
    const Scene quantised =
        with_draco(draco_bytes(g, 20, true), g.positions.size(), g.indices.size()).load();
    EXPECT_EQ(quantised.triangles.size(), g.indices.size() / 3);
    EXPECT_NEAR(surface_area(quantised), surface_area(load_plain(g)), 1e-3);
}

TEST(GltfDraco, DataThatIsNotWhatTheFileSays) {
    const Grid g = grid(5);
    const Bytes bytes = draco_bytes(g, 0, true);
    const std::size_t vertices = g.positions.size(), indices = g.indices.size();
    EXPECT_THAT(with_draco(bytes, vertices + 1, indices).problem(), HasSubstr("25 vertices"));
    EXPECT_THAT(with_draco(bytes, vertices, indices + 3).problem(), HasSubstr("96 indices"));
    EXPECT_THAT(with_draco({7}, vertices, indices).problem(), HasSubstr("damaged"));
    EXPECT_THAT(with_draco(Bytes(100, 7), vertices, indices).problem(), HasSubstr("damaged"));
    const json::json_pointer extension("/meshes/0/primitives/0/extensions/" +
                                       std::string(draco_name));
    const auto problem_with = [&](const std::string& key, const json& value) {
        GltfBuilder builder = with_draco(bytes, vertices, indices);
        builder.root[extension / json::json_pointer(key)] = value;
        return builder.problem();
    };
    EXPECT_THAT(problem_with("/bufferView", 9), HasSubstr("bufferView"));
    EXPECT_THAT(problem_with("/bufferView", -1), HasSubstr("bufferView"));
    EXPECT_THAT(problem_with("/attributes/POSITION", 7), HasSubstr("no attribute 7 for POSITION"));
    EXPECT_THAT(problem_with("/attributes/COLOR_0", 0), HasSubstr("the primitive lacks"));
    EXPECT_THAT(problem_with("/attributes", "all"), HasSubstr("has no \"attributes\""));
}

TEST(GltfDraco, SurvivesTruncationAndDamage) {
    const Grid g = grid(6);
    for (const bool edgebreaker : {false, true}) {
        const Bytes bytes = draco_bytes(g, 11, edgebreaker);
        const auto try_bytes = [&](const Bytes& damaged) {
            expect_scene_or_error(with_draco(damaged, g.positions.size(), g.indices.size()));
        };
        for (std::size_t size = 0; size < bytes.size(); size += 7) {
            try_bytes({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)});
        }
        for (std::size_t place = 5; place < bytes.size(); place += place < 64 ? 1 : 11) {
            for (const std::uint8_t value : {0x00, 0x7f, 0xff}) {
                Bytes damaged = bytes;
                damaged[place] = value;
                try_bytes(damaged);
            }
        }
    }
}

TEST(GltfDraco, CountsThatTheDataCannotHold) {
    for (const std::uint8_t method : {0, 1}) {
        Bytes bytes{'D', 'R', 'A', 'C', 'O', 2, 2, 1, method, 0, 0};
        if (method == 1) {
            bytes.push_back(0);
        }
        bytes.insert(bytes.end(), {0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff, 0x7f});
        bytes.resize(100);
        const GltfBuilder builder = with_draco(bytes, 0xfffffff, 3 * std::size_t(0xfffffff));
        EXPECT_THAT(builder.problem(), HasSubstr("too few for 268435455 triangles or vertices"));
        expect_scene_or_error(builder);
    }
}

#else

TEST(GltfDraco, ABuildWithoutItNamesThePackage) {
    EXPECT_THAT(requiring(one_triangle(), draco_name).problem(), HasSubstr("libdraco-dev"));
}

#endif

#ifdef ARGAND_HAVE_MESHOPTIMIZER

Bytes encoded_vertices(const void* data, std::size_t count, std::size_t size) {
    Bytes bytes(meshopt_encodeVertexBufferBound(count, size));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), data, count, size));
    return bytes;
}

Bytes encoded_indices(const Grid& g, bool triangles) {
    Bytes bytes(triangles ? meshopt_encodeIndexBufferBound(g.indices.size(), g.positions.size())
                          : meshopt_encodeIndexSequenceBound(g.indices.size(), g.positions.size()));
    bytes.resize(triangles ? meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), g.indices.data(),
                                                       g.indices.size())
                           : meshopt_encodeIndexSequence(bytes.data(), bytes.size(),
                                                         g.indices.data(), g.indices.size()));
    return bytes;
}

/// Adds a compressed view. Its data without compression would be in the fallback buffer, number 1.
int add_compressed(GltfBuilder& builder, const Bytes& bytes, std::size_t count, std::size_t stride,
                   const char* mode, const char* filter = nullptr) {
    const int view = builder.add_view(bytes);
    json& object = builder.root["bufferViews"][static_cast<std::size_t>(view)];
    json extension = object;
    extension["byteStride"] = stride;
    extension["count"] = count;
    extension["mode"] = mode;
    if (filter) {
        extension["filter"] = filter;
    }
    object = {
        {"buffer", 1}, {"byteLength", count * stride}, {"extensions", {{meshopt_name, extension}}}};
    if (std::string(mode) == "ATTRIBUTES") {
        object["byteStride"] = stride;
    }
    return view;
}

/// A file whose second buffer is the one that compression stands for.
GltfBuilder meshopt_builder() {
    GltfBuilder builder;
    builder.root["extensionsUsed"] = {meshopt_name};
    builder.root["extensionsRequired"] = {meshopt_name};
    builder.further_buffers.push_back(
        {{"byteLength", 123456789}, {"extensions", {{meshopt_name, {{"fallback", true}}}}}});
    return builder;
}

GltfBuilder with_meshopt(const Grid& g, bool as_triangles) {
    GltfBuilder builder = meshopt_builder();
    const std::size_t count = g.positions.size(), corners = g.indices.size();
    const int p = add_compressed(builder, encoded_vertices(g.positions.data(), count, 12), count,
                                 12, "ATTRIBUTES");
    const int n = add_compressed(builder, encoded_vertices(g.normals.data(), count, 12), count, 12,
                                 "ATTRIBUTES");
    const int i = add_compressed(builder, encoded_indices(g, as_triangles), corners, 4,
                                 as_triangles ? "TRIANGLES" : "INDICES");
    const int positions = builder.add_accessor(p, float_type, "VEC3", count),
              normals = builder.add_accessor(n, float_type, "VEC3", count),
              indices = builder.add_accessor(i, uint_type, "SCALAR", corners);
    builder.add_node(
        {{"mesh", builder.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                                    {"indices", indices}})}});
    return builder;
}

TEST(GltfMeshopt, MeshesAreThoseWithoutCompression) {
    for (const std::uint32_t side : {2u, 3u, 37u}) {
        const Grid g = grid(side);
        const std::vector<Triangle> plain = triangles_of(load_plain(g));
        for (const bool as_triangles : {true, false}) {
            const Scene scene = with_meshopt(g, as_triangles).load();
            EXPECT_EQ(triangles_of(scene), plain);
            EXPECT_FALSE(has_note(scene, meshopt_name));
        }
    }
}

TEST(GltfMeshopt, FiltersAreUndone) {
    const Grid g = grid(12);
    const std::size_t count = g.positions.size();
    std::vector<float> wide;
    for (const glm::vec3& n : g.normals) {
        wide.insert(wide.end(), {n.x, n.y, n.z, 0});
    }
    Bytes positions(count * 12), normals(count * 8);
    meshopt_encodeFilterExp(positions.data(), count, 12, 20, &g.positions[0].x);
    meshopt_encodeFilterOct(normals.data(), count, 8, 16, wide.data());
    GltfBuilder builder = meshopt_builder();
    const int p = add_compressed(builder, encoded_vertices(positions.data(), count, 12), count, 12,
                                 "ATTRIBUTES", "EXPONENTIAL");
    const int n = add_compressed(builder, encoded_vertices(normals.data(), count, 8), count, 8,
                                 "ATTRIBUTES", "OCTAHEDRAL");
    const int of_positions = builder.add_accessor(p, float_type, "VEC3", count),
              of_normals = builder.add_accessor(n, short_type, "VEC3", count);
    builder.root["accessors"][static_cast<std::size_t>(of_normals)]["normalized"] = true;
    const int indices = builder.add_indices(g.indices);
    builder.add_node(
        {{"mesh",
          builder.add_mesh({{"attributes", {{"POSITION", of_positions}, {"NORMAL", of_normals}}},
                            {"indices", indices}})}});
    const Scene scene = builder.load(), plain = load_plain(g);
    ASSERT_EQ(scene.positions.size(), plain.positions.size());
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        testing_gltf::expect_near(scene.positions[i], plain.positions[i], 1e-4);
        testing_gltf::expect_near(scene.normals[i], plain.normals[i], 1e-3);
    }
}

TEST(GltfMeshopt, DataThatIsNotWhatTheFileSays) {
    const Grid g = grid(5);
    const auto problem_with = [&](int view, const std::string& key, const json& value) {
        GltfBuilder builder = with_meshopt(g, true);
        builder.root[json::json_pointer(
            fmt::format("/bufferViews/{}/extensions/{}/{}", view, meshopt_name, key))] = value;
        return builder.problem();
    };
    EXPECT_THAT(problem_with(0, "mode", "POINTS"), HasSubstr("mode \"POINTS\""));
    EXPECT_THAT(problem_with(0, "filter", "OCTAHEDRAL"), HasSubstr("filter \"OCTAHEDRAL\""));
    EXPECT_THAT(problem_with(2, "filter", "EXPONENTIAL"), HasSubstr("filter \"EXPONENTIAL\""));
    EXPECT_THAT(problem_with(0, "byteStride", 13), HasSubstr("13 bytes"));
    EXPECT_THAT(problem_with(0, "byteStride", 0), HasSubstr("0 bytes"));
    EXPECT_THAT(problem_with(0, "byteStride", 512), HasSubstr("512 bytes"));
    EXPECT_THAT(problem_with(2, "byteStride", 3), HasSubstr("3 bytes"));
    EXPECT_THAT(problem_with(2, "count", 95), HasSubstr("no multiple of three"));
    EXPECT_THAT(problem_with(0, "count", 24), HasSubstr("25 elements"));
    EXPECT_THAT(problem_with(0, "buffer", 7), HasSubstr("buffer 7, which does not exist"));
    EXPECT_THAT(problem_with(0, "byteLength", 1 << 20), HasSubstr("goes past"));
    EXPECT_THAT(problem_with(0, "byteOffset", -4), HasSubstr("\"byteOffset\" that is an integer"));
    for (const std::uint64_t count :
         {std::uint64_t(1) << 20, std::uint64_t(1) << 40, std::uint64_t(1) << 53}) {
        EXPECT_THAT(problem_with(0, "count", count), HasSubstr("too few for"));
        EXPECT_THAT(problem_with(2, "count", 3 * (count / 3)), HasSubstr("too few for"));
    }
    EXPECT_THAT(problem_with(0, "count", 1e300), HasSubstr("\"count\" that is an integer"));
}

TEST(GltfMeshopt, SurvivesTruncationAndDamage) {
    const Grid g = grid(6);
    const GltfBuilder whole = with_meshopt(g, true);
    for (std::size_t place = 0; place < whole.binary.size(); place += 3) {
        for (const std::uint8_t value : {0x00, 0x7f, 0xff}) {
            GltfBuilder damaged = whole;
            damaged.binary[place] = value;
            EXPECT_EQ(damaged.problem().find('\n'), std::string::npos);
        }
    }
    for (const int view : {0, 1, 2}) {
        const std::size_t length = whole.root["bufferViews"][static_cast<std::size_t>(view)]
                                             ["extensions"][meshopt_name]["byteLength"];
        for (std::size_t size = 0; size < length; size += 5) {
            GltfBuilder cut = whole;
            cut.root["bufferViews"][static_cast<std::size_t>(view)]["extensions"][meshopt_name]
                    ["byteLength"] = size;
            EXPECT_THAT(cut.problem(), HasSubstr("compressed")) << view << ", " << size;
        }
    }
}

#else

TEST(GltfMeshopt, ABuildWithoutItNamesThePackage) {
    EXPECT_THAT(requiring(one_triangle(), meshopt_name).problem(),
                HasSubstr("libmeshoptimizer-dev"));
}

#endif

} // namespace
} // namespace argand
