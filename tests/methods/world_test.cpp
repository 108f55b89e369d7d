// A scene that moves on a device: each moment has the picture of a world that is built for it.
#include "rendering.hpp"

#include "scene/pose.hpp"
#include "support/recording_device.hpp"
#include "world/world.hpp"

#include <cmath>
#include <utility>

namespace argand::testing {
namespace {

/// Keys at 0 and 1 second.
KeyFrames between(const glm::dvec3& from, const glm::dvec3& to) {
    return {.times = {0, 1}, .values = {from.x, from.y, from.z, to.x, to.y, to.z}, .width = 3};
}

/// A room with a smooth, moving fan of triangles, a mirrored one, and a moving lamp beside those
/// that stand still.
Scene moving_scene(std::uint32_t triangles = 50) {
    Scene scene = room_scene();
    scene.name = "moving";
    scene.motion.nodes.resize(3);
    scene.motion.nodes[0].keys.translation = between({-0.5, 0.3, 0}, {0.5, 0.6, 0.2});
    scene.motion.nodes[1].keys.scale = between({0.5, 0.5, 0.5}, {-0.5, 0.5, 0.5});
    scene.motion.nodes[2].keys.translation = between({0, 1, 0}, {0.5, 1, 0.5});
    for (const std::uint32_t node : {0u, 1u}) {
        MovingMesh mesh{.name = "fan",
                        .node = node,
                        .first_vertex = scene.positions.size(),
                        .first_triangle = scene.triangles.size(),
                        .triangles = triangles};
        const auto first = static_cast<std::uint32_t>(mesh.first_vertex);
        mesh.positions.emplace_back(0, 0, 0);
        for (std::uint32_t i = 0; i <= triangles; ++i) {
            const float angle = 6.0f * static_cast<float>(i) / static_cast<float>(triangles);
            mesh.positions.emplace_back(0.4f * std::cos(angle), 0.4f * std::sin(angle),
                                        0.1f * std::sin(5 * angle));
        }
        mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
        for (std::uint32_t i = 1; i <= triangles; ++i) {
            scene.triangles.emplace_back(first, first + i, first + i + 1);
            scene.triangle_material.push_back(0);
        }
        scene.positions.resize(scene.positions.size() + mesh.positions.size());
        scene.normals.resize(scene.positions.size());
        scene.motion.meshes.push_back(std::move(mesh));
    }
    Light lamp;
    lamp.intensity = glm::vec3(0.2f);
    scene.lights.push_back(lamp);
    scene.motion.lights.push_back({.node = 2, .index = scene.lights.size() - 1, .light = lamp});
    move_to(0, scene);
    return scene;
}

RenderResult render_in(World& world, const Scene& scene, const RenderSettings& settings) {
    return argand::render(world, scene, settings, [](double) { return true; });
}

class MovingWorld : public EveryMethod {};

TEST_P(MovingWorld, EveryMomentHasThePictureOfAFreshWorld) {
    RenderSettings settings = settings_of(GetParam(), 16, 2);
    settings.photons = 5'000;
    Scene scene = moving_scene();
    World world(device(), scene);
    RenderResult before;
    for (const double time : {0.0, 0.25, 1.0, 0.5, 0.0}) {
        move_to(time, scene);
        world.update(scene);
        const RenderResult result = render_in(world, scene, settings);
        EXPECT_TRUE(same_bits(result, render(scene, settings))) << time;
        EXPECT_FALSE(same_bits(result, before)) << time;
        before = result;
    }
}

INSTANTIATE_METHODS(MovingWorld);

class WorldUpdates : public RenderTest {
protected:
    Scene scene_ = moving_scene();
};

TEST_F(WorldUpdates, TouchOnlyWhatHasChanged) {
    RecordingDevice recording(device());
    World world(recording, scene_);
    EXPECT_EQ(recording.runs_of("lbvh_codes"), 1u);
    const auto expect_nothing = [&] {
        const WorldUpdate update = world.update(scene_);
        EXPECT_EQ(update.moved_meshes, 0u);
        EXPECT_EQ(update.uploaded_bytes, 0u);
        EXPECT_FALSE(update.refitted || update.rebuilt);
        EXPECT_EQ(recording.runs_of("ray_refit"), 1u);
    };
    expect_nothing();
    // Lights and cameras belong to a render.
    scene_.lights.back().position.x += 1;
    scene_.cameras[0].position.x += 0.1f;
    expect_nothing();
    // One of two meshes: 16 bytes for each of its vertices.
    scene_.motion.nodes[1].keys = {};
    scene_.motion.nodes[1].rest.scale = glm::dvec3(0.5);
    move_to(0.3, scene_);
    WorldUpdate update = world.update(scene_);
    EXPECT_EQ(update.moved_meshes, 1u);
    EXPECT_EQ(update.uploaded_bytes, 16 * scene_.motion.meshes[0].positions.size());
    EXPECT_TRUE(update.refitted);
    EXPECT_EQ(recording.runs_of("ray_refit"), 2u);
    EXPECT_EQ(recording.runs_of("lbvh_codes"), 1u);
    // Mirrored: its vertices and its triangles.
    scene_.motion.nodes[1].rest.scale.x *= -1;
    move_to(0.3, scene_);
    update = world.update(scene_);
    const MovingMesh& mirrored = scene_.motion.meshes[1];
    EXPECT_EQ(update.moved_meshes, 1u);
    EXPECT_EQ(update.uploaded_bytes, 16 * (mirrored.positions.size() + mirrored.triangles));
}

TEST_F(WorldUpdates, RebuildTheTreeOnceRaysWouldVisitManyMoreNodes) {
    scene_ = moving_scene(400);
    World world(device(), scene_);
    scene_.motion.nodes[0].keys.translation = between({0, 0, 0}, {40, 0, 0});
    move_to(0.001, scene_);
    WorldUpdate update = world.update(scene_);
    EXPECT_TRUE(update.refitted);
    EXPECT_FALSE(update.rebuilt);
    move_to(1, scene_);
    update = world.update(scene_);
    EXPECT_FALSE(update.refitted);
    EXPECT_TRUE(update.rebuilt);
    RenderSettings settings = settings_of("path", 16, 2);
    EXPECT_TRUE(same_bits(render_in(world, scene_, settings), render(scene_, settings)));
}

TEST_F(WorldUpdates, RendersShareATree) {
    RecordingDevice recording(device());
    World world(recording, scene_);
    RenderSettings settings = settings_of("path", 8, 1);
    const RenderResult first = render_in(world, scene_, settings);
    settings.method = "photons";
    settings.photons = 1000;
    const std::uint64_t codes = recording.runs_of("ray_nodes");
    render_in(world, scene_, settings);
    EXPECT_EQ(recording.runs_of("ray_nodes"), codes);
    settings.method = "path";
    EXPECT_TRUE(same_bits(first, render_in(world, scene_, settings)));
}

} // namespace
} // namespace argand::testing
