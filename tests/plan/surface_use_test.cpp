#include "plan/surface_use.hpp"

#include "methods/scenes.hpp"

#include <gmock/gmock.h>

namespace argand::testing {
namespace {

using ::testing::ElementsAre;

Scene three_materials() {
    Scene scene;
    for (int i = 0; i < 3; ++i) {
        add_material(scene, lambertian(glm::vec3(0.5f)));
    }
    add_floor(scene, 1, 0, 2);
    add_triangle(scene, {0, 1, 0}, {1, 1, 0}, {0, 1, 1}, 0);
    add_floor(scene, 1, -1, 2);
    return scene;
}

TEST(SurfaceUse, CountsTheTrianglesOfMaterials) {
    const SurfaceUse use = surface_use(three_materials());
    EXPECT_THAT(use.materials, ElementsAre(2, 0));
    EXPECT_THAT(use.triangles, ElementsAre(1, 0, 4));
    EXPECT_FALSE(use.smoothed);
}

TEST(SurfaceUse, FindsNormalsThatMorphTargetsBring) {
    Scene scene = three_materials();
    const std::uint32_t vertex = scene.triangles[2].y; // of material 0
    MovingMesh mesh{.first_vertex = vertex};
    mesh.positions.resize(1);
    mesh.normals.resize(1, glm::vec3(0));
    mesh.targets.push_back({.normals = {{0, 1, 0}}});
    scene.motion.meshes.push_back(mesh);
    EXPECT_EQ(surface_use(scene).smoothed, 0u);
    scene.normals[scene.triangles[1].z] = {0, 1, 0};
    EXPECT_EQ(surface_use(scene).smoothed, 2u);
}

} // namespace
} // namespace argand::testing
