// Tangents of normal textures, against the directions in which texture coordinates grow.
#include "scene/tangents.hpp"

#include "shared/tangent.h"
#include "shared/texture_record.h"

#include <gtest/gtest.h>

namespace argand {
namespace {

/// Triangles of a material with a normal texture; corners by position and texture coordinates.
struct Mesh {
    Scene scene;
    Mesh() {
        scene.materials.emplace_back();
        scene.materials[0].texture_bits = material_normal_texture;
        scene.materials[0].texture_count = 1;
        scene.textures.push_back({.use = TextureUse::normal});
        scene.uv_sets = 1;
    }
    void add(const std::array<glm::vec3, 3>& positions, const std::array<glm::vec2, 3>& uvs,
             const glm::vec3& normal = glm::vec3(0)) {
        const auto first = static_cast<std::uint32_t>(scene.positions.size());
        for (std::size_t k = 0; k < 3; ++k) {
            scene.positions.push_back(positions[k]);
            scene.uvs.push_back(uvs[k]);
            scene.normals.push_back(normal);
        }
        scene.triangles.emplace_back(first, first + 1, first + 2);
        scene.triangle_material.push_back(0);
    }
    /// The normal that a slope makes in the middle of a triangle.
    glm::vec3 turned(std::size_t triangle, const glm::vec3& slope) {
        const glm::uvec3& t = scene.triangles[triangle];
        const glm::vec3 edge = scene.positions[t.y] - scene.positions[t.x];
        const glm::vec3 flat =
            glm::normalize(glm::cross(edge, scene.positions[t.z] - scene.positions[t.x]));
        return from_tangents(flat, edge, scene.tangents[triangle], vec2(0.3f, 0.3f), slope);
    }
};

void expect_near(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_LT(glm::distance(a, b), 2e-4f) << a.x << " " << a.y << " " << a.z;
}

// In glTF v grows downwards, and green of a normal texture points up.
TEST(Tangents, FollowTextureCoordinates) {
    Mesh mesh; // faces +z, u along +x, v along -y
    mesh.add({glm::vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}}, {glm::vec2(0, 1), {1, 1}, {0, 0}});
    // The same, begun at another corner; turned by a quarter; mirrored.
    mesh.add({glm::vec3(1, 0, 0), {0, 1, 0}, {0, 0, 0}}, {glm::vec2(1, 1), {0, 0}, {0, 1}});
    mesh.add({glm::vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}}, {glm::vec2(0, 0), {0, 1}, {1, 0}});
    mesh.add({glm::vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}}, {glm::vec2(1, 1), {0, 1}, {1, 0}});
    add_tangents(mesh.scene);
    ASSERT_EQ(mesh.scene.tangents.size(), 4u);
    for (const std::size_t same : {0, 1}) {
        expect_near(mesh.turned(same, {1, 0, 0}), {1, 0, 0});
        expect_near(mesh.turned(same, {0, 1, 0}), {0, 1, 0});
        expect_near(mesh.turned(same, {0.6f, 0, 0.8f}), {0.6f, 0, 0.8f});
    }
    expect_near(mesh.turned(2, {1, 0, 0}), {0, 1, 0});
    expect_near(mesh.turned(2, {0, 1, 0}), {-1, 0, 0});
    expect_near(mesh.turned(3, {1, 0, 0}), {-1, 0, 0});
    expect_near(mesh.turned(3, {0, 1, 0}), {0, 1, 0});
}

TEST(Tangents, OfTheFileReplaceThem) {
    Mesh mesh;
    mesh.add({glm::vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}}, {glm::vec2(0, 1), {1, 1}, {0, 0}});
    mesh.scene.vertex_tangents.assign(3, glm::vec4(0.6f, 0.8f, 0, -1));
    add_tangents(mesh.scene);
    expect_near(mesh.turned(0, {1, 0, 0}), {0.6f, 0.8f, 0});
    expect_near(mesh.turned(0, {0, 1, 0}), {0.8f, -0.6f, 0});
}

TEST(Tangents, AreAveragedOverSmoothCorners) {
    Mesh mesh; // two triangles of a plane that share an edge, with directions of u 90° apart
    const glm::vec3 up(0, 0, 1);
    mesh.add({glm::vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}}, {glm::vec2(0, 0), {1, 0}, {0, -1}}, up);
    mesh.add({glm::vec3(1, 0, 0), {1, 1, 0}, {0, 1, 0}}, {glm::vec2(1, 0), {2, 0}, {0, -1}}, up);
    add_tangents(mesh.scene);
    // At the corner (1,0,0): 45° of the first triangle, along x, and 45° of the second.
    const glm::vec2 first = unpack_tangent(mesh.scene.tangents[0].y);
    const glm::vec2 lonely = unpack_tangent(mesh.scene.tangents[0].x);
    EXPECT_NEAR(lonely.x, 1, 1e-4);
    EXPECT_LT(first.x, 0.999f);
    EXPECT_GT(first.x, 0.5f);
}

TEST(Tangents, AreFiniteWhereCoordinatesAreEqual) {
    Mesh mesh;
    mesh.add({glm::vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}}, {glm::vec2(3, 3), {3, 3}, {3, 3}});
    mesh.add({glm::vec3(0, 0, 0), {0, 0, 0}, {0, 0, 0}}, {glm::vec2(0, 0), {1, 0}, {0, 1}});
    add_tangents(mesh.scene);
    const glm::vec3 turned = mesh.turned(0, {0.6f, 0, 0.8f});
    EXPECT_NEAR(glm::length(turned), 1, 1e-5);
    EXPECT_NEAR(turned.z, 0.8f, 1e-4);
}

// Anisotropy needs tangents, with or without a texture of its own.
TEST(Tangents, OfAnisotropicSurfaces) {
    for (const bool has_texture : {false, true}) {
        Mesh mesh;
        Material& m = mesh.scene.materials[0];
        m.anisotropy = {0.5f, 0};
        if (has_texture) {
            m.texture_bits = material_other_textures;
            mesh.scene.textures[0] = {.transform = glm::mat3x2(0, 1, -1, 0, 0, 0),
                                      .use = TextureUse::anisotropy};
        } else {
            m.texture_bits = m.texture_count = 0;
        }
        mesh.add({glm::vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}}, {glm::vec2(0, 1), {1, 1}, {0, 0}});
        add_tangents(mesh.scene);
        ASSERT_EQ(mesh.scene.tangents.size(), 1u);
        // The texture's u grows as the vertices' -v, upwards.
        expect_near(mesh.turned(0, {1, 0, 0}),
                    has_texture ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0));
    }
    Mesh bare; // without coordinates some direction is taken
    bare.scene.materials[0].anisotropy = {0, 1};
    bare.scene.materials[0].texture_bits = bare.scene.materials[0].texture_count = 0;
    bare.add({glm::vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}}, {glm::vec2(0), {0, 0}, {0, 0}});
    bare.scene.uv_sets = 0;
    bare.scene.uvs.clear();
    add_tangents(bare.scene);
    EXPECT_NEAR(glm::length(bare.turned(0, {1, 0, 0})), 1, 1e-5);
}

TEST(Tangents, ScenesWithoutNormalTexturesHaveNone) {
    Mesh mesh;
    mesh.scene.materials[0].texture_bits = material_base_color_texture;
    mesh.add({glm::vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}}, {glm::vec2(0, 1), {1, 1}, {0, 0}});
    add_tangents(mesh.scene);
    EXPECT_TRUE(mesh.scene.tangents.empty());
}

} // namespace
} // namespace argand
