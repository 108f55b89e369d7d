// The casters of caustics, at rest and in motion, against the scene that the host moves.
#include "world/caster_table.hpp"

#include "device_fixture.hpp"
#include "methods/moving_scene.hpp"
#include "scene/pose.hpp"
#include "world/world.hpp"

#include <algorithm>
#include <gmock/gmock.h>

namespace argand::testing {
namespace {

using ::testing::SizeIs;

class CausticCasters : public DeviceTest {
protected:
    std::vector<glm::vec4> spheres_of(const Scene& scene, float follow_roughness = 0.25f) {
        Device& device = open();
        const DeviceScene on_device = upload_scene(
            device, scene,
            make_plan(scene, {.follow_roughness = follow_roughness, .everything = true}));
        std::vector<glm::vec4> spheres =
            caster_spheres(device, *on_device.casters, on_device.positions);
        EXPECT_EQ(on_device.casters->empty(), spheres.empty());
        std::sort(spheres.begin(), spheres.end(),
                  [](const glm::vec4& a, const glm::vec4& b) { return a.x < b.x; });
        return spheres;
    }
};

TEST_F(CausticCasters, AreConnectedSurfacesOfGlassAndMirrors) {
    Scene scene;
    const std::uint32_t white = add_material(scene, lambertian(glm::vec3(0.7f)));
    const std::uint32_t clear = add_material(scene, glass(1.5f, true));
    const std::uint32_t silver = add_material(scene, mirror());
    add_box(scene, {-2, 0, -2}, {2, 2.5f, 2}, white, true);
    EXPECT_THAT(spheres_of(scene), SizeIs(0));
    add_box(scene, {0, 0, 0}, {0.1f, 0.2f, 0.2f}, clear, false);
    add_box(scene, {1, 0, 0}, {1.1f, 0.2f, 0.2f}, clear, false);
    add_quad(scene, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, silver);
    const std::vector<glm::vec4> spheres = spheres_of(scene);
    ASSERT_THAT(spheres, SizeIs(3));
    EXPECT_NEAR(spheres[0].x, 0.05f, 1e-6f);
    EXPECT_NEAR(spheres[0].y, 0.1f, 1e-6f);
    EXPECT_NEAR(spheres[0].w, 0.15f, 3e-4f);
    EXPECT_NEAR(spheres[1].y, 1.5f, 1e-6f);
    EXPECT_NEAR(spheres[1].w, std::sqrt(0.5f), 1e-3f);
    EXPECT_NEAR(spheres[2].x, 1.05f, 1e-6f);
}

TEST_F(CausticCasters, GlossyOnesDependOnTheRoughnessThatIsFollowed) {
    Scene scene;
    Material rough = mirror();
    rough.roughness = 0.2f;
    add_quad(scene, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, add_material(scene, rough));
    EXPECT_THAT(spheres_of(scene, 0.25f), SizeIs(1));
    EXPECT_THAT(spheres_of(scene, 0.1f), SizeIs(0));
}

Bounds box_of_mesh(const Scene& scene, const MovingMesh& mesh) {
    Bounds box;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        box.low = glm::min(box.low, scene.positions[mesh.first_vertex + i]);
        box.high = glm::max(box.high, scene.positions[mesh.first_vertex + i]);
    }
    return box;
}

void expect_around(const glm::vec4& sphere, const Bounds& box) {
    const glm::vec3 center = 0.5f * (box.low + box.high);
    EXPECT_LE(glm::distance(glm::vec3(sphere), center), 1e-6f);
    EXPECT_NEAR(sphere.w, glm::distance(center, box.high), 2e-3f * sphere.w);
}

/// moving_scene() with a small pane at rest; its two fans and the pane are of glass.
Scene glass_fans(std::uint32_t triangles) {
    Scene scene = moving_scene(triangles);
    const std::uint32_t clear = add_material(scene, glass(1.5f, false));
    for (const MovingMesh& mesh : scene.motion.meshes) {
        std::fill_n(scene.triangle_material.begin() +
                        static_cast<std::ptrdiff_t>(mesh.first_triangle),
                    mesh.triangles, clear);
    }
    add_quad(scene, {5, 5, 5}, {0.1f, 0, 0}, {0, 0.1f, 0}, clear);
    return scene;
}

// A part has 512 vertices, and lavapipe ends loops after 65,535 iterations.
TEST_F(CausticCasters, FollowTheMeshesThatMove) {
    for (const std::uint32_t triangles : {1u, 509u, 510u, 511u, 70'001u}) {
        SCOPED_TRACE(triangles);
        Scene scene = glass_fans(triangles);
        World world(open(), scene);
        const Plan plan = make_plan(scene, {.everything = true});
        const std::shared_ptr<const CasterTable> table = world.on_device(scene, plan).casters;
        for (const double time : {0.75, 0.25}) {
            move_to(time, scene);
            world.update(scene);
            const DeviceScene on_device = world.on_device(scene, plan);
            EXPECT_EQ(on_device.casters, table);
            const std::vector<glm::vec4> spheres =
                caster_spheres(open(), *on_device.casters, on_device.positions);
            ASSERT_THAT(spheres, SizeIs(3));
            for (std::size_t i = 0; i < 2; ++i) {
                expect_around(spheres[i], box_of_mesh(scene, scene.motion.meshes[i]));
            }
            expect_around(spheres[2], {.low = {5, 5, 5}, .high = {5.1f, 5.1f, 5}});
        }
    }
}

// Both fans have the same object space; the nodes take them to different places.
TEST_F(CausticCasters, OfOneNodeAreConnected) {
    Scene scene = glass_fans(7);
    scene.motion.meshes[1].node = scene.motion.meshes[0].node;
    move_to(0.5, scene);
    EXPECT_THAT(spheres_of(scene), SizeIs(2));
}

TEST_F(CausticCasters, AreFoundAnewWhereMaterialsBecomeGlass) {
    Scene scene = changing_scene(); // whose third material becomes glass
    World world(open(), scene);
    const Plan plan = make_plan(scene, {.everything = true});
    EXPECT_TRUE(world.on_device(scene, plan).casters->empty());
    move_to(0.5, scene);
    world.update(scene);
    EXPECT_FALSE(world.on_device(scene, plan).casters->empty());
}

} // namespace
} // namespace argand::testing
