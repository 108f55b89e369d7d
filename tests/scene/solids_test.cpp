#include "methods/scenes.hpp"
#include "scene/solids.hpp"

#include <gtest/gtest.h>

namespace argand::testing {
namespace {

using Materials = std::vector<std::uint32_t>;

/// A cube of a solid of its own.
std::uint32_t add_cube(Scene& scene, float low, float high, float priority = 0) {
    Material m = glass(1.5f, true);
    m.priority = priority;
    const std::uint32_t material = add_material(scene, m);
    add_box(scene, glm::vec3(low), glm::vec3(high), material, false);
    return material;
}

TEST(SolidRanks, LargerVolumesAreLower) {
    Scene scene;
    EXPECT_EQ(solid_ranks(scene).materials, Materials());
    const std::uint32_t ice = add_cube(scene, 0.4f, 0.6f);
    const std::uint32_t water = add_cube(scene, 0, 1);
    const std::uint32_t drop = add_cube(scene, 10, 10.1f);
    EXPECT_EQ(solid_ranks(scene).materials, (Materials{water, ice, drop}));
    // Of a hollow body only what is between its walls counts.
    const std::uint32_t vessel = add_cube(scene, -0.01f, 1.01f);
    add_box(scene, glm::vec3(0), glm::vec3(1), vessel, true);
    EXPECT_EQ(solid_ranks(scene).materials, (Materials{water, vessel, ice, drop}));
}

TEST(SolidRanks, PriorityComesBeforeVolume) {
    Scene scene;
    const std::uint32_t ice = add_cube(scene, 0.4f, 0.6f, -1);
    const std::uint32_t water = add_cube(scene, 0, 1);
    const std::uint32_t glass = add_cube(scene, 0, 2, 0.5f);
    EXPECT_EQ(solid_ranks(scene).materials, (Materials{ice, water, glass}));
}

TEST(SolidRanks, CavitiesAreThoseOfTheSameGlassAround) {
    Scene scene;
    const std::uint32_t outside = add_cube(scene, 0, 1);
    const std::uint32_t inside = add_material(scene, scene.materials[outside]);
    add_box(scene, glm::vec3(0.1f), glm::vec3(0.9f), inside, true);
    const std::uint32_t water = add_cube(scene, 0.05f, 0.8f, 1);
    const SolidRanks ranks = solid_ranks(scene);
    EXPECT_EQ(ranks.materials, (Materials{outside, water}));
    EXPECT_EQ(ranks.of_material, (Materials{1, 1, 2}));
    EXPECT_EQ(solid_ranks(scene).overlapping, std::pair(outside, water));
    // Of another glass, or where nothing is around, they are solids like others.
    scene.materials[inside].ior = 1.4f;
    EXPECT_EQ(solid_ranks(scene).materials, (Materials{outside, inside, water}));
    Scene room;
    add_box(room, glm::vec3(-1), glm::vec3(1), add_material(room, glass(1.5f, true)), true);
    EXPECT_EQ(solid_ranks(room).of_material, Materials{1});
}

TEST(SolidRanks, OthersHaveNone) {
    Scene scene = box_scene(lambertian(glm::vec3(0.5f)));
    add_box(scene, glm::vec3(0), glm::vec3(0.5f), add_material(scene, glass(1.5f, false)), false);
    add_material(scene, glass(1.5f, true)); // of no triangle
    EXPECT_EQ(solid_ranks(scene).materials, Materials());
    EXPECT_FALSE(solid_ranks(scene).overlapping);
}

TEST(ThinBodies, AreClosedAndTransmitWithoutThickness) {
    Scene scene;
    add_cube(scene, 0, 1);
    const std::uint32_t thin = add_material(scene, glass(1.5f, false));
    add_quad(scene, glm::vec3(0), {1, 0, 0.2f}, {0, 1, 0.1f}, thin);
    add_cube(scene, 2, 3);
    EXPECT_EQ(thin_bodies(scene), Materials());
    add_box(scene, glm::vec3(-2), glm::vec3(-1), thin, false);
    EXPECT_EQ(thin_bodies(scene), Materials());
    const std::uint32_t ball = add_material(scene, glass(1.5f, false));
    add_sphere(scene, {5, 0, 0}, 1, 8, true, ball);
    EXPECT_EQ(thin_bodies(scene), Materials{ball});
}

TEST(SolidRanks, OpenSurfacesAreThoseOfSomethingLarge) {
    Scene scene;
    const std::uint32_t ball = add_cube(scene, -1, 1);
    const std::uint32_t sea = add_material(scene, glass(1.33f, true));
    add_quad(scene, {-0.9f, 0, 0.9f}, {1.8f, 0, 0}, {0, 0, -1.8f}, sea);
    EXPECT_EQ(solid_ranks(scene).materials, (Materials{sea, ball}));
}

TEST(SolidRanks, MaterialsThatMayBecomeSolidsHaveOne) {
    Scene scene;
    const std::uint32_t block = add_cube(scene, 0, 1);
    for (auto [property, keys] : {std::pair(&Material::thickness, &MaterialKeys::thickness),
                                  {&Material::transmission, &MaterialKeys::transmission}}) {
        Scene moving = scene;
        moving.materials[block].*property = 0;
        EXPECT_EQ(solid_ranks(moving).materials, Materials());
        MovingMaterial& motion = moving.motion.materials.emplace_back();
        motion.index = block;
        (motion.keys.*keys).emplace();
        EXPECT_EQ(solid_ranks(moving).materials, Materials{block});
    }
    scene.materials[block].metallic = 1; // metal transmits nothing
    EXPECT_EQ(solid_ranks(scene).materials, Materials());
}

TEST(SolidRanks, OfAFileAreThoseAtRest) {
    Scene scene;
    add_cube(scene, 0, 1);
    add_cube(scene, 0, 2);
    scene.solids = solid_ranks(scene);
    for (glm::vec3& p : scene.positions) {
        p *= p.x > 1 ? 0.1f : 1;
    }
    EXPECT_EQ(known_solid_ranks(scene).materials, (Materials{1, 0}));
    scene.solids.reset();
    EXPECT_EQ(known_solid_ranks(scene).materials, (Materials{0, 1}));
}

TEST(OverlappingSolids, AreFoundByTheirBoxes) {
    Scene scene;
    const std::uint32_t a = add_cube(scene, 0, 1);
    EXPECT_FALSE(solid_ranks(scene).overlapping);
    const std::uint32_t beside = add_cube(scene, 1, 2);
    EXPECT_FALSE(solid_ranks(scene).overlapping); // they touch
    scene.motion.meshes.emplace_back();
    EXPECT_EQ(solid_ranks(scene).overlapping, std::pair(a, beside)); // they may move
    scene.motion.meshes.clear();
    const std::uint32_t inside = add_cube(scene, 0.25f, 0.5f);
    EXPECT_EQ(solid_ranks(scene).overlapping, std::pair(a, inside));
}

} // namespace
} // namespace argand::testing
