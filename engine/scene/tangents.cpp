#include "scene/tangents.hpp"

#include "base/hash_floats.hpp"
#include "scene/moving_factors.hpp"
#include "shared/tangent.h"
#include "shared/texture_record.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <unordered_map>

namespace argand {

namespace {

/// What corners have in common that share a tangent: position, normal, texture coordinates, and
/// handedness.
using Corner = std::array<float, 9>;

glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double size = glm::length(v);
    return size > 0 ? v / size : otherwise;
}

glm::dvec3 flattened(const glm::dvec3& v, const glm::dvec3& normal) {
    return unit_or(v - normal * glm::dot(v, normal), glm::dvec3(0));
}

/// A triangle whose material needs tangents.
struct Textured {
    std::array<std::uint32_t, 3> vertices;
    std::array<glm::dvec3, 3> positions;
    std::array<glm::vec2, 3> uvs; ///< as the texture transforms them
    glm::dvec3 tangent{0};        ///< unit direction in which u grows
    bool left_handed = false;

    double angle_at(std::size_t corner) const {
        const glm::dvec3 a = unit_or(positions[(corner + 1) % 3] - positions[corner], {});
        const glm::dvec3 b = unit_or(positions[(corner + 2) % 3] - positions[corner], {});
        return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
    }
};

/// texture: its coordinates count; if there is none, those of the first set.
Textured textured(const Scene& scene, std::size_t index, const Texture* texture) {
    Textured t;
    const std::uint32_t uv_set = texture ? texture->uv_set : 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = scene.triangles[index][int(k)];
        t.vertices[k] = vertex;
        t.positions[k] = scene.positions[vertex];
        const glm::vec2 uv = scene.uv_sets > 0
                                 ? scene.uvs[std::size_t{vertex} * scene.uv_sets + uv_set]
                                 : glm::vec2(0);
        t.uvs[k] = texture ? glm::vec2(texture->transform * glm::vec3(uv, 1)) : uv;
    }
    const glm::dvec2 u1 = glm::dvec2(t.uvs[1]) - glm::dvec2(t.uvs[0]);
    const glm::dvec2 u2 = glm::dvec2(t.uvs[2]) - glm::dvec2(t.uvs[0]);
    const double area = u1.x * u2.y - u1.y * u2.x;
    const glm::dvec3 edge = t.positions[1] - t.positions[0];
    // v grows downwards, the bitangent points up: where the image is not mirrored, this area is
    // negative, and normal × tangent points up.
    t.left_handed = area > 0;
    const glm::dvec3 along = edge * u2.y - (t.positions[2] - t.positions[0]) * u1.y;
    t.tangent = unit_or(area < 0 ? -along : along, unit_or(edge, {1, 0, 0}));
    return t;
}

Corner corner_of(const Scene& scene, const Textured& t, std::size_t k) {
    const glm::vec3& p = scene.positions[t.vertices[k]];
    const glm::vec3& n = scene.normals[t.vertices[k]];
    return {p.x, p.y, p.z, n.x, n.y, n.z, t.uvs[k].x, t.uvs[k].y, t.left_handed ? -1.0f : 1.0f};
}

using Sums = std::unordered_map<Corner, glm::dvec3, HashFloats>;

std::uint32_t packed_at(const Scene& scene, const Textured& t, std::size_t k, const Sums& sums) {
    const std::uint32_t vertex = t.vertices[k];
    const glm::dvec3 edge = t.positions[1] - t.positions[0];
    const glm::dvec3 flat =
        unit_or(glm::cross(edge, t.positions[2] - t.positions[0]), glm::dvec3(0, 0, 1));
    const glm::dvec3 normal = unit_or(scene.normals[vertex], flat);
    glm::dvec3 tangent = t.tangent;
    bool left_handed = t.left_handed;
    if (vertex < scene.vertex_tangents.size() && scene.vertex_tangents[vertex].w != 0) {
        tangent = glm::vec3(scene.vertex_tangents[vertex]);
        left_handed = scene.vertex_tangents[vertex].w < 0;
    } else if (const auto sum = sums.find(corner_of(scene, t, k)); sum != sums.end()) {
        tangent = unit_or(sum->second, t.tangent);
    }
    const glm::dvec3 x = flattened(edge, normal);
    const glm::dvec3 along = flattened(tangent, normal);
    const glm::vec2 angle(glm::dot(along, x), glm::dot(along, glm::cross(normal, x)));
    return pack_tangent(angle == glm::vec2(0) ? glm::vec2(1, 0) : angle, left_handed);
}

} // namespace

bool needs_tangents(const Scene& scene, std::uint32_t material) {
    const Material& of = scene.materials[material];
    const MovingMaterial* moving = moving_material(scene.motion, material);
    return (of.texture_bits & material_normal_texture) != 0 || of.coat_has_normal ||
           of.anisotropy != glm::vec2(0) || (moving && moving->keys.anisotropy);
}

const Texture* tangent_texture(const Scene& scene, std::uint32_t material) {
    const Material& of = scene.materials[material];
    const Texture* found = nullptr;
    for (std::uint32_t i = 0; i < of.texture_count; ++i) {
        const Texture& texture = scene.textures[of.first_texture + i];
        if (texture.use == TextureUse::normal) {
            return &texture;
        }
        if (texture.use == TextureUse::coat_normal ||
            (texture.use == TextureUse::anisotropy && !found)) {
            found = &texture;
        }
    }
    return found;
}

void add_tangents(Scene& scene) {
    std::vector<bool> needed(scene.materials.size());
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        needed[i] = needs_tangents(scene, i);
    }
    std::vector<std::size_t> indices;
    std::vector<Textured> list;
    Sums sums;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const std::uint32_t index = scene.triangle_material[i];
        if (!needed[index]) {
            continue;
        }
        indices.push_back(i);
        list.push_back(textured(scene, i, tangent_texture(scene, index)));
        const Textured& t = list.back();
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 normal = scene.normals[t.vertices[k]];
            if (normal != glm::dvec3(0)) {
                sums[corner_of(scene, t, k)] += flattened(t.tangent, normal) * t.angle_at(k);
            }
        }
    }
    if (list.empty()) {
        return;
    }
    scene.tangents.assign(scene.triangles.size(), glm::uvec3(0));
    for (std::size_t j = 0; j < list.size(); ++j) {
        for (std::size_t k = 0; k < 3; ++k) {
            scene.tangents[indices[j]][int(k)] = packed_at(scene, list[j], k, sums);
        }
    }
}

} // namespace argand
