#pragma once

#include "base/error.hpp"
#include "scene/gltf.hpp"
#include "support/scratch_directory.hpp"
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace argand::testing_gltf {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

// glTF's numbers for component types and primitive modes.
inline constexpr int byte_type = 5120, ubyte_type = 5121, short_type = 5122, ushort_type = 5123,
                     uint_type = 5125, float_type = 5126;
inline constexpr int points = 0, line_strip = 3, triangles = 4, strip = 5, fan = 6;

/// A directory for scene files, removed at the end.
struct TempDirectory : argand::testing::ScratchDirectory {
    std::filesystem::path write(const std::string& name, const std::string& content) const {
        const std::filesystem::path file = *this / name;
        std::filesystem::create_directories(file.parent_path());
        argand::testing::write_text(file, content);
        return file;
    }
    std::filesystem::path write(const std::string& name, const Bytes& bytes) const {
        return write(name, std::string(bytes.begin(), bytes.end()));
    }
};

inline void put_word(Bytes& bytes, std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<std::uint8_t>(value >> shift));
    }
}

/// A binary glTF with these two chunks; without a BIN chunk if `binary` is empty.
inline Bytes make_glb(std::string text, Bytes binary) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, 0);
    Bytes glb{'g', 'l', 'T', 'F'};
    put_word(glb, 2);
    put_word(glb, static_cast<std::uint32_t>(12 + 8 + text.size() +
                                             (binary.empty() ? 0 : 8 + binary.size())));
    put_word(glb, static_cast<std::uint32_t>(text.size()));
    glb.insert(glb.end(), {'J', 'S', 'O', 'N'});
    glb.insert(glb.end(), text.begin(), text.end());
    if (!binary.empty()) {
        put_word(glb, static_cast<std::uint32_t>(binary.size()));
        glb.insert(glb.end(), {'B', 'I', 'N', 0});
        glb.insert(glb.end(), binary.begin(), binary.end());
    }
    return glb;
}

/// Builds a glTF file: one buffer, and the JSON, which tests may change.
struct GltfBuilder {
    json root{
        {"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", json::array()}}}}};
    Bytes binary;
    std::vector<json> further_buffers; ///< behind that of `binary`

    static int append(json& list, json element) {
        list.push_back(std::move(element));
        return static_cast<int>(list.size()) - 1;
    }

    template <class T> int add_view(const std::vector<T>& elements, int stride = 0) {
        binary.resize((binary.size() + 3) / 4 * 4, 0);
        json view{{"buffer", 0},
                  {"byteOffset", binary.size()},
                  {"byteLength", elements.size() * sizeof(T)}};
        if (stride > 0) {
            view["byteStride"] = stride;
        }
        const auto* data = reinterpret_cast<const std::uint8_t*>(elements.data());
        binary.insert(binary.end(), data, data + elements.size() * sizeof(T));
        return append(root["bufferViews"], view);
    }
    int add_accessor(int view, int component_type, const std::string& type, std::size_t count,
                     std::size_t offset = 0) {
        return append(root["accessors"], {{"bufferView", view},
                                          {"byteOffset", offset},
                                          {"componentType", component_type},
                                          {"type", type},
                                          {"count", count}});
    }
    int add_vectors(const std::vector<glm::vec3>& vectors) {
        return add_accessor(add_view(vectors), float_type, "VEC3", vectors.size());
    }
    template <class T> int add_indices(const std::vector<T>& indices) {
        const int type = sizeof(T) == 1 ? ubyte_type : sizeof(T) == 2 ? ushort_type : uint_type;
        return add_accessor(add_view(indices), type, "SCALAR", indices.size());
    }
    int add_mesh(json primitive) {
        return append(root["meshes"], {{"primitives", json::array({std::move(primitive)})}});
    }
    /// Adds a node to the first scene.
    int add_node(json node) {
        const int index = append(root["nodes"], std::move(node));
        root["scenes"][0]["nodes"].push_back(index);
        return index;
    }
    /// Adds a node that shows an unindexed mesh of these vertices.
    int add_triangles(const std::vector<glm::vec3>& corners, json node = json::object()) {
        node["mesh"] = add_mesh({{"attributes", {{"POSITION", add_vectors(corners)}}}});
        return add_node(node);
    }

    Bytes glb() const {
        json complete = root;
        if (!binary.empty()) {
            complete["buffers"] = json::array({{{"byteLength", binary.size()}}});
        }
        for (const json& buffer : further_buffers) {
            complete["buffers"].push_back(buffer);
        }
        return make_glb(complete.dump(), binary);
    }
    Scene load() const {
        const TempDirectory directory;
        return load_gltf(directory.write("scene.glb", glb()));
    }
    /// The message of the Error that loading throws; "" if it throws none.
    std::string problem() const {
        try {
            load();
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
};

/// The unit right triangle in the plane z = 0, counter-clockwise seen from +z.
inline std::vector<glm::vec3> right_triangle() { return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}; }

/// A file with only that triangle.
inline GltfBuilder one_triangle() {
    GltfBuilder builder;
    builder.add_triangles(right_triangle());
    return builder;
}

inline std::vector<glm::vec3> corners_of(const Scene& scene, std::size_t triangle) {
    const glm::uvec3& corners = scene.triangles.at(triangle);
    return {scene.positions.at(corners.x), scene.positions.at(corners.y),
            scene.positions.at(corners.z)};
}

/// Geometric normal by the winding; its length is twice the area.
inline glm::dvec3 winding_normal(const Scene& scene, std::size_t triangle) {
    const std::vector<glm::vec3> c = corners_of(scene, triangle);
    return glm::cross(glm::dvec3(c[1]) - glm::dvec3(c[0]), glm::dvec3(c[2]) - glm::dvec3(c[0]));
}

inline bool has_note(const Scene& scene, const std::string& part) {
    for (const std::string& note : scene.notes) {
        if (note.find(part) != std::string::npos) {
            return true;
        }
    }
    return false;
}

inline void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-6) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

} // namespace argand::testing_gltf
