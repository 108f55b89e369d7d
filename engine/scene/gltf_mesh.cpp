#include "scene/gltf_mesh.hpp"

#include "scene/direction.hpp"
#include "scene/gltf_accessor.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {
namespace {

constexpr std::size_t most_triangles = std::size_t(1) << 27; // 134 million, about 10 GB on the host
constexpr std::uint32_t none = 0xffffffffu;

/// The opened accessors of a primitive.
struct Surface {
    GltfAccessor positions;
    GltfAccessor normals;
    GltfAccessor indices;
    bool has_normals = false;
    bool has_indices = false;
    int mode = TINYGLTF_MODE_TRIANGLES;
    std::size_t corner_count = 0; ///< indices, or vertices if there are no indices
};

struct Transform {
    glm::dmat4 point;
    glm::dmat3 normal;
    bool mirrors; ///< flips the orientation of triangles
};

std::size_t triangle_count(int mode, std::size_t corners) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        return corners / 3;
    }
    return corners < 3 ? 0 : corners - 2;
}

/// Corners of triangle `i` as positions in the index list: glTF 2.0, section 3.7.2.1.
glm::uvec3 triangle_corners(int mode, std::uint32_t i) {
    switch (mode) {
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        return {i, i + 1 + i % 2, i + 2 - i % 2};
    case TINYGLTF_MODE_TRIANGLE_FAN:
        return {i + 1, i + 2, 0};
    default:
        return {3 * i, 3 * i + 1, 3 * i + 2};
    }
}

Transform make_transform(const glm::dmat4& to_world) {
    // Normals are transformed by the matrix of cofactors, which is the inverse transpose up to a
    // factor and exists for singular matrices too. The matrix is first scaled to about 1 so that
    // products neither overflow nor vanish.
    glm::dmat3 m(to_world);
    double largest = 0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            largest = std::max(largest, std::abs(m[column][row]));
        }
    }
    if (largest > 0 && std::isfinite(largest)) {
        m = glm::dmat3(m[0] / largest, m[1] / largest, m[2] / largest);
    }
    const bool mirrors = glm::dot(m[0], glm::cross(m[1], m[2])) < 0;
    const double sign = mirrors ? -1 : 1;
    const glm::dmat3 cofactors(sign * glm::cross(m[1], m[2]), sign * glm::cross(m[2], m[0]),
                               sign * glm::cross(m[0], m[1]));
    return {to_world, cofactors, mirrors};
}

bool fits_float(const glm::dvec3& v) {
    constexpr double largest = std::numeric_limits<float>::max();
    return std::abs(v.x) <= largest && std::abs(v.y) <= largest &&
           std::abs(v.z) <= largest; // false for NaN
}

bool has_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::cross(b - a, c - a) != glm::dvec3(0);
}

int attribute(const tinygltf::Primitive& primitive, const char* name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
}

bool is_attribute_type(const GltfAccessor& accessor) {
    return accessor.components == 3 &&
           accessor.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// Opens the primitive's accessors. Returns false if it has no surface (points, lines, no
/// positions, no corners).
bool open_surface(const GltfSource& source, const tinygltf::Primitive& primitive,
                  const std::string& name, Surface& surface, Scene& scene) {
    surface.mode = primitive.mode;
    if (surface.mode < TINYGLTF_MODE_POINTS || surface.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        source.fail("{} has a primitive of mode {}, which glTF does not know", name, surface.mode);
    }
    if (surface.mode < TINYGLTF_MODE_TRIANGLES) {
        add_note(scene, "points and lines are not rendered");
        return false;
    }
    if (attribute(primitive, "POSITION") < 0) {
        add_note(scene,
                 fmt::format("{} has a primitive without positions; it is not rendered", name));
        return false;
    }
    surface.positions =
        open_accessor(source, attribute(primitive, "POSITION"), "the positions of " + name);
    if (!is_attribute_type(surface.positions)) {
        source.fail(
            "the positions of {} are not three-component vectors of a type that glTF allows", name);
    }
    surface.has_normals = attribute(primitive, "NORMAL") >= 0;
    if (surface.has_normals) {
        surface.normals =
            open_accessor(source, attribute(primitive, "NORMAL"), "the normals of " + name);
        if (!is_attribute_type(surface.normals)) {
            source.fail(
                "the normals of {} are not three-component vectors of a type that glTF allows",
                name);
        }
        if (surface.normals.count != surface.positions.count) {
            source.fail("{} has {} positions but {} normals", name, surface.positions.count,
                        surface.normals.count);
        }
    }
    surface.corner_count = surface.positions.count;
    surface.has_indices = primitive.indices >= 0;
    if (surface.has_indices) {
        surface.indices = open_accessor(source, primitive.indices, "the indices of " + name);
        const int type = surface.indices.component_type;
        if (surface.indices.components != 1 || (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
                                                type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
                                                type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
            source.fail("the indices of {} are not unsigned integers", name);
        }
        surface.corner_count = surface.indices.count;
    }
    if (surface.mode == TINYGLTF_MODE_TRIANGLES && surface.corner_count % 3 != 0) {
        add_note(scene,
                 fmt::format(
                     "{} has {} corners, which is no multiple of three; the last ones are ignored",
                     name, surface.corner_count));
    }
    return triangle_count(surface.mode, surface.corner_count) > 0;
}

void note_ignored_features(const tinygltf::Primitive& primitive, Scene& scene) {
    if (!primitive.targets.empty()) {
        add_note(scene, "morph targets are not supported yet: meshes keep their base shape");
    }
    for (const auto& [name, accessor] : primitive.attributes) {
        if (name.starts_with("COLOR_")) {
            add_note(scene, "vertex colours are not supported yet and are ignored");
        }
    }
}

std::uint32_t material_of(const GltfSource& source, const tinygltf::Primitive& primitive,
                          const std::string& name, Scene& scene) {
    const std::size_t in_file = source.model.materials.size();
    if (primitive.material >= 0) {
        if (std::size_t(primitive.material) >= in_file) {
            source.fail("{} refers to material {}, which does not exist", name, primitive.material);
        }
        return static_cast<std::uint32_t>(primitive.material);
    }
    if (scene.materials.size() == in_file) {
        Material plain; // glTF 2.0, section 3.7.2.1: the default material
        plain.name = "default";
        scene.materials.push_back(plain);
    }
    return static_cast<std::uint32_t>(in_file);
}

std::size_t stated_count(const GltfSource& source, int accessor) {
    const auto& accessors = source.model.accessors;
    return accessor >= 0 && std::size_t(accessor) < accessors.size()
               ? accessors[std::size_t(accessor)].count
               : 0;
}

/// Throws Error if the nodes show more triangles than the scene can hold. Checks the counts stated
/// in the file before anything is read, because a short file can show a large mesh many times.
void check_triangle_count(const GltfSource& source, const std::vector<GltfNode>& nodes) {
    std::size_t total = 0;
    for (const GltfNode& node : nodes) {
        const int mesh = source.model.nodes[std::size_t(node.index)].mesh;
        if (mesh < 0 || std::size_t(mesh) >= source.model.meshes.size()) {
            continue;
        }
        for (const tinygltf::Primitive& primitive :
             source.model.meshes[std::size_t(mesh)].primitives) {
            if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
                continue;
            }
            const int corners =
                primitive.indices >= 0 ? primitive.indices : attribute(primitive, "POSITION");
            const std::size_t count = triangle_count(primitive.mode, stated_count(source, corners));
            if (count > most_triangles - total) {
                source.fail("its scene has more than {} triangles", most_triangles);
            }
            total += count;
        }
    }
}

/// A vertex of the current primitive, in world space.
struct StagedVertex {
    glm::vec3 position;
    glm::vec3 normal;
    std::uint32_t in_scene = none; ///< index in the scene, once a triangle uses the vertex
};

/// Adds meshes; holds the state that outlives a primitive.
struct MeshAdder {
    const GltfSource& source;
    Scene& scene;
    std::vector<StagedVertex> staged;
    std::vector<std::uint32_t>
        staged_as; ///< For each vertex of the primitive its index in `staged`, or `none`.
    std::size_t without_area = 0;
    std::size_t invisible = 0; ///< primitives whose alpha is 0 or below their cutoff

    StagedVertex read_vertex(const Surface& surface, const Transform& transform, std::size_t vertex,
                             const std::string& name) const {
        const glm::dvec3 local = read_vec3(surface.positions, vertex);
        const glm::dvec3 position(transform.point * glm::dvec4(local, 1));
        if (!fits_float(position)) {
            source.fail("vertex {} of {} has a position that is not finite{}", vertex, name,
                        is_finite(local) ? " in world space" : "");
        }
        glm::vec3 normal(0);
        if (surface.has_normals) {
            const glm::dvec3 local_normal = read_vec3(surface.normals, vertex);
            if (!is_finite(local_normal)) {
                source.fail("vertex {} of {} has a normal that is not finite", vertex, name);
            }
            normal = glm::vec3(unit_or_zero(transform.normal * local_normal));
        }
        return {glm::vec3(position), normal, none};
    }

    std::uint32_t stage_corner(const Surface& surface, const Transform& transform,
                               std::uint32_t corner, const std::string& name) {
        const std::size_t vertex =
            surface.has_indices ? read_index(surface.indices, corner) : corner;
        if (vertex >= surface.positions.count) {
            source.fail("{} has index {}, but only {} vertices", name, vertex,
                        surface.positions.count);
        }
        if (staged_as[vertex] == none) {
            staged.push_back(read_vertex(surface, transform, vertex, name));
            staged_as[vertex] = static_cast<std::uint32_t>(staged.size() - 1);
        }
        return staged_as[vertex];
    }

    std::uint32_t add_vertex(StagedVertex& vertex) const {
        if (vertex.in_scene == none) {
            vertex.in_scene = static_cast<std::uint32_t>(scene.positions.size());
            scene.positions.push_back(vertex.position);
            scene.normals.push_back(vertex.normal);
        }
        return vertex.in_scene;
    }

    void add(const Surface& surface, const Transform& transform, std::uint32_t material,
             const std::string& name) {
        const std::size_t triangles = triangle_count(surface.mode, surface.corner_count);
        if (staged_as.size() < surface.positions.count) {
            staged_as.resize(surface.positions.count, none);
        }
        for (std::uint32_t i = 0; i < triangles; ++i) {
            glm::uvec3 corners = triangle_corners(surface.mode, i);
            if (transform.mirrors) {
                std::swap(corners.y, corners.z);
            }
            for (int k = 0; k < 3; ++k) {
                corners[k] = stage_corner(surface, transform, corners[k], name);
            }
            if (has_area(staged[corners.x].position, staged[corners.y].position,
                         staged[corners.z].position)) {
                glm::uvec3 triangle(0);
                for (int k = 0; k < 3; ++k) {
                    triangle[k] = add_vertex(staged[corners[k]]);
                }
                scene.triangles.push_back(triangle);
                scene.triangle_material.push_back(material);
            } else {
                ++without_area;
            }
        }
        // Reset only the entries in use: many primitives may share one long vertex buffer.
        for (std::size_t corner = 0; corner < surface.corner_count; ++corner) {
            staged_as[surface.has_indices ? read_index(surface.indices, corner) : corner] = none;
        }
        staged.clear();
    }
};

} // namespace

void add_meshes(const GltfSource& source, const std::vector<GltfNode>& nodes, Scene& scene) {
    check_triangle_count(source, nodes);
    MeshAdder adder{source, scene, {}, {}, 0, 0};
    for (const GltfNode& node : nodes) {
        const tinygltf::Node& shown = source.model.nodes[std::size_t(node.index)];
        if (shown.mesh < 0) {
            continue;
        }
        if (std::size_t(shown.mesh) >= source.model.meshes.size()) {
            source.fail("{} refers to mesh {}, which does not exist",
                        label("node", node.index, shown.name), shown.mesh);
        }
        if (shown.skin >= 0) {
            add_note(
                scene,
                "skins are not supported yet: meshes keep the pose in which they were modelled");
        }
        const tinygltf::Mesh& mesh = source.model.meshes[std::size_t(shown.mesh)];
        const std::string name = label("mesh", shown.mesh, mesh.name);
        const Transform transform = make_transform(node.to_world);
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            Surface surface;
            if (open_surface(source, primitive, name, surface, scene)) {
                note_ignored_features(primitive, scene);
                const std::uint32_t material = material_of(source, primitive, name, scene);
                if (scene.materials[material].coverage > 0) {
                    adder.add(surface, transform, material, name);
                } else {
                    ++adder.invisible;
                }
            }
        }
    }
    if (adder.invisible > 0) {
        scene.notes.push_back(fmt::format(
            "{} primitive{} left out because alpha makes {} invisible", adder.invisible,
            adder.invisible == 1 ? " is" : "s are", adder.invisible == 1 ? "it" : "them"));
    }
    if (adder.without_area > 0) {
        scene.notes.push_back(fmt::format("{} triangle{} without area {} left out",
                                          adder.without_area, adder.without_area == 1 ? "" : "s",
                                          adder.without_area == 1 ? "is" : "are"));
    }
}

} // namespace argand
