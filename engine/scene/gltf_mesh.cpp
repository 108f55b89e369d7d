#include "scene/gltf_mesh.hpp"

#include "scene/direction.hpp"
#include "scene/gltf_morph.hpp"
#include "scene/gltf_skin.hpp"
#include "scene/gltf_surface.hpp"
#include "scene/gltf_vertex.hpp"
#include "scene/moving_factors.hpp"
#include "scene/placement.hpp"
#include "scene/pose.hpp"
#include "scene/tangents.hpp"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace argand {
namespace {

constexpr std::size_t most_triangles = std::size_t(1) << 27; // 134 million, about 10 GB on the host
constexpr std::uint32_t none = 0xffffffffu;

bool has_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::cross(b - a, c - a) != glm::dvec3(0);
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
        if (mesh < 0 || node.is_instanced || std::size_t(mesh) >= source.model.meshes.size()) {
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

/// A vertex of the current primitive.
struct StagedVertex {
    std::size_t in_file;           ///< index in the primitive's accessors
    glm::vec3 position, normal;    ///< in world space, or of a moving mesh in object space
    glm::vec4 tangent{0};          ///< in world space; see Scene::vertex_tangents
    std::uint32_t in_scene = none; ///< index in the scene, once a triangle uses the vertex
};

/// Adds meshes; holds the state that outlives a primitive.
class MeshAdder {
public:
    MeshAdder(const GltfSource& source, Scene& scene) : source_(source), scene_(scene) {}

    /// Adds a primitive whose vertices stay where they are. Leaves out triangles without area.
    void add(const Surface& surface, const VertexTransform& transform, std::uint32_t material,
             const std::string& name) {
        const auto read = [&](std::size_t vertex) {
            return read_world(surface, transform, vertex, name);
        };
        for_each_triangle(surface, transform.mirrors, name, read, [&](const glm::uvec3& corners) {
            if (!has_area(staged_[corners.x].position, staged_[corners.y].position,
                          staged_[corners.z].position)) {
                ++without_area_;
                return;
            }
            glm::uvec3 triangle(0);
            for (int k = 0; k < 3; ++k) {
                triangle[k] = add_vertex(surface, staged_[corners[k]], material, name);
            }
            scene_.triangles.push_back(triangle);
            scene_.triangle_material.push_back(material);
        });
    }

    /// Adds a primitive with all its triangles: one without area now may have some later. Fills in
    /// what `mesh` lacks, and returns the index of each vertex in the primitive's accessors. The
    /// vertices wait to be placed.
    std::vector<std::size_t> add_moving(const Surface& surface, std::uint32_t material,
                                        MovingMesh& mesh) {
        mesh.first_vertex = scene_.positions.size();
        mesh.first_triangle = scene_.triangles.size();
        std::vector<std::size_t> vertices;
        const auto read = [&](std::size_t vertex) {
            return read_object(surface, vertex, mesh.name);
        };
        for_each_triangle(surface, false, mesh.name, read, [&](const glm::uvec3& corners) {
            glm::uvec3 triangle(0);
            for (int k = 0; k < 3; ++k) {
                StagedVertex& vertex = staged_[corners[k]];
                if (vertex.in_scene == none) {
                    mesh.positions.push_back(vertex.position);
                    mesh.normals.push_back(vertex.normal);
                    vertices.push_back(vertex.in_file);
                }
                triangle[k] = add_vertex(surface, vertex, material, mesh.name);
            }
            scene_.triangles.push_back(triangle);
            scene_.triangle_material.push_back(material);
        });
        mesh.triangles = scene_.triangles.size() - mesh.first_triangle;
        return vertices;
    }

    void count_invisible() { ++invisible_; }

    /// Adds notes about what was left out.
    void add_notes() const {
        if (invisible_ > 0) {
            scene_.notes.push_back(
                fmt::format("{} primitive{} left out because alpha makes {} invisible", invisible_,
                            invisible_ == 1 ? " is" : "s are", invisible_ == 1 ? "it" : "them"));
        }
        if (without_area_ > 0) {
            scene_.notes.push_back(fmt::format("{} triangle{} without area {} left out",
                                               without_area_, without_area_ == 1 ? "" : "s",
                                               without_area_ == 1 ? "is" : "are"));
        }
    }

private:
    glm::dvec3 read_normal(const Surface& surface, std::size_t vertex,
                           const std::string& name) const {
        if (!surface.has_normals) {
            return glm::dvec3(0);
        }
        const glm::dvec3 normal = read_vec3(surface.normals, vertex);
        if (!is_finite(normal)) {
            source_.fail("vertex {} of {} has a normal that is not finite", vertex, name);
        }
        return normal;
    }

    /// Of a vertex that stays where it is; 0 if the file has none.
    glm::vec4 read_tangent(const Surface& surface, const VertexTransform& transform,
                           std::size_t vertex, const std::string& name) const {
        if (!surface.has_tangents) {
            return glm::vec4(0);
        }
        glm::dvec4 tangent;
        for (int i = 0; i < 4; ++i) {
            tangent[i] = read_component(surface.tangents, vertex, i);
        }
        if (!is_finite(glm::dvec3(tangent)) || !std::isfinite(tangent.w)) {
            source_.fail("vertex {} of {} has a tangent that is not finite", vertex, name);
        }
        const glm::dvec3 world = unit_or_zero(glm::dmat3(transform.point) * glm::dvec3(tangent));
        const bool left_handed = (tangent.w < 0) != transform.mirrors;
        return world == glm::dvec3(0) ? glm::vec4(0)
                                      : glm::vec4(glm::vec3(world), left_handed ? -1 : 1);
    }

    StagedVertex read_world(const Surface& surface, const VertexTransform& transform,
                            std::size_t vertex, const std::string& name) const {
        const glm::dvec3 local = read_vec3(surface.positions, vertex);
        const glm::dvec3 position(transform.point * glm::dvec4(local, 1));
        if (!fits_float(position)) {
            source_.fail("vertex {} of {} has a position that is not finite{}", vertex, name,
                         is_finite(local) ? " in world space" : "");
        }
        const glm::dvec3 normal = transform.normal * read_normal(surface, vertex, name);
        return {vertex, glm::vec3(position), glm::vec3(unit_or_zero(normal)),
                read_tangent(surface, transform, vertex, name)};
    }

    StagedVertex read_object(const Surface& surface, std::size_t vertex,
                             const std::string& name) const {
        const glm::dvec3 position = read_vec3(surface.positions, vertex);
        if (!fits_float(position)) {
            source_.fail("vertex {} of {} has a position that is not finite", vertex, name);
        }
        return {vertex, glm::vec3(position), glm::vec3(read_normal(surface, vertex, name)),
                glm::vec4(0)};
    }

    template <class Read>
    std::uint32_t stage_corner(const Surface& surface, std::uint32_t corner,
                               const std::string& name, const Read& read) {
        const std::size_t vertex =
            surface.has_indices ? read_index(surface.indices, corner) : corner;
        if (vertex >= surface.positions.count) {
            source_.fail("{} has index {}, but only {} vertices", name, vertex,
                         surface.positions.count);
        }
        if (staged_as_[vertex] == none) {
            staged_.push_back(read(vertex));
            staged_as_[vertex] = static_cast<std::uint32_t>(staged_.size() - 1);
        }
        return staged_as_[vertex];
    }

    /// Calls `take` for each triangle with its corners' indices in `staged_`.
    template <class Read, class Take>
    void for_each_triangle(const Surface& surface, bool mirrors, const std::string& name,
                           const Read& read, const Take& take) {
        const std::size_t triangles = triangle_count(surface.mode, surface.corner_count);
        if (staged_as_.size() < surface.positions.count) {
            staged_as_.resize(surface.positions.count, none);
        }
        for (std::uint32_t i = 0; i < triangles; ++i) {
            glm::uvec3 corners = triangle_corners(surface.mode, i);
            if (mirrors) {
                std::swap(corners.y, corners.z);
            }
            for (int k = 0; k < 3; ++k) {
                corners[k] = stage_corner(surface, corners[k], name, read);
            }
            take(corners);
        }
        // Reset only the entries in use: many primitives may share one long vertex buffer.
        for (const StagedVertex& vertex : staged_) {
            staged_as_[vertex.in_file] = none;
        }
        staged_.clear();
    }

    std::uint32_t add_vertex(const Surface& surface, StagedVertex& vertex, std::uint32_t material,
                             const std::string& name) const {
        if (vertex.in_scene == none) {
            vertex.in_scene = static_cast<std::uint32_t>(scene_.positions.size());
            add_texture_attributes(source_, surface, vertex.in_file, material, name, scene_);
            scene_.positions.push_back(vertex.position);
            scene_.normals.push_back(vertex.normal);
            if (vertex.tangent.w != 0) {
                scene_.vertex_tangents.resize(scene_.positions.size(), glm::vec4(0));
                scene_.vertex_tangents.back() = vertex.tangent;
            }
        }
        return vertex.in_scene;
    }

    const GltfSource& source_;
    Scene& scene_;
    std::vector<StagedVertex> staged_;
    /// For each vertex of the primitive its index in `staged_`, or `none`.
    std::vector<std::uint32_t> staged_as_;
    std::size_t without_area_ = 0;
    std::size_t invisible_ = 0; ///< primitives whose alpha is 0 or below their cutoff
};

/// The morph targets of a node's mesh have an effect, now or later.
bool is_morphed(const MotionNode& node) {
    return node.keys.weights.has_value() ||
           std::any_of(node.weights.begin(), node.weights.end(), [](double w) { return w != 0; });
}

} // namespace

void add_meshes(const GltfSource& source, const std::vector<GltfNode>& nodes, Scene& scene) {
    check_triangle_count(source, nodes);
    MeshAdder adder(source, scene);
    Skins skins(source, nodes);
    std::size_t vectors_left = most_morph_vectors;
    const Pose rest = pose_at(scene.motion, {});
    for (std::size_t number = 0; number < nodes.size(); ++number) {
        const GltfNode& node = nodes[number];
        const tinygltf::Node& shown = source.model.nodes[std::size_t(node.index)];
        if (shown.mesh < 0 || node.is_instanced) {
            continue;
        }
        if (std::size_t(shown.mesh) >= source.model.meshes.size()) {
            source.fail("{} refers to mesh {}, which does not exist",
                        label("node", node.index, shown.name), shown.mesh);
        }
        const tinygltf::Mesh& mesh = source.model.meshes[std::size_t(shown.mesh)];
        const std::string name = label("mesh", shown.mesh, mesh.name);
        const VertexTransform transform = vertex_transform(node.to_world);
        const MotionNode& motion = scene.motion.nodes[number];
        const std::size_t first_triangle = scene.triangles.size();
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            Surface surface;
            if (!open_surface(source, primitive, name, surface, scene)) {
                continue;
            }
            const std::uint32_t material = material_of(source, primitive, name, scene);
            if (!may_be_visible(scene, material)) {
                adder.count_invisible();
                continue;
            }
            open_texture_attributes(source, primitive, name, material, surface, scene);
            if (shown.skin < 0 && !node.moves && !is_morphed(motion)) {
                adder.add(surface, transform, material, name);
                continue;
            }
            MovingMesh moving{.name = name, .node = static_cast<std::uint32_t>(number)};
            const std::vector<std::size_t> vertices = adder.add_moving(surface, material, moving);
            bool moves = node.moves || motion.keys.weights.has_value();
            if (shown.skin >= 0) {
                moving.skin = skins.number_of(shown.skin, scene);
                moving.joint_weights =
                    skins.weights_of(shown.skin, primitive, vertices, name, scene);
                moves = motion.keys.weights.has_value() || skins.moves(shown.skin);
            }
            moving.targets =
                read_morph_targets(source, primitive, surface, vertices, name, vectors_left);
            place(moving, rest, scene);
            if (moves) {
                scene.motion.meshes.push_back(std::move(moving));
            }
        }
        if (scene.triangles.size() > first_triangle) {
            scene.objects.push_back({.node = static_cast<std::uint32_t>(node.index),
                                     .name = shown.name,
                                     .first_triangle = static_cast<std::uint32_t>(first_triangle)});
        }
    }
    adder.add_notes();
    add_tangents(scene);
}

} // namespace argand
