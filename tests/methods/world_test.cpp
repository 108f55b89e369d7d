// A scene that moves on a device: each moment has the picture of a world that is built for it.
#include "moving_scene.hpp"
#include "rendering.hpp"
#include "support/recording_device.hpp"
#include "world/world.hpp"

namespace argand::testing {
namespace {

RenderResult render_in(World& world, const Scene& scene, const RenderSettings& settings) {
    return argand::render(world, scene, settings, [](double) { return true; });
}

class MovingWorld : public EveryMethod {
protected:
    void expect_pictures_of_fresh_worlds(Scene scene) {
        RenderSettings settings = settings_of(GetParam(), 16, 2);
        settings.photons = 5'000;
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
};

TEST_P(MovingWorld, EveryMomentHasThePictureOfAFreshWorld) {
    expect_pictures_of_fresh_worlds(moving_scene());
}

TEST_P(MovingWorld, LightsAndMaterialsThatChangeDoSoOnTheDevice) {
    expect_pictures_of_fresh_worlds(changing_scene());
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

TEST_F(WorldUpdates, UploadOnlyTheMaterialsThatHaveChanged) {
    scene_ = changing_scene();
    World world(device(), scene_);
    WorldUpdate update = world.update(scene_);
    EXPECT_EQ(update.changed_materials, 0u);
    EXPECT_EQ(update.uploaded_bytes, 0u);
    move_to(0.5, scene_);
    update = world.update(scene_);
    EXPECT_EQ(update.changed_materials, 3u);
    EXPECT_EQ(update.uploaded_bytes, 3 * sizeof(MaterialRecord));
    EXPECT_FALSE(update.refitted || update.rebuilt);
    scene_.motion.materials.pop_back();
    scene_.motion.materials.erase(scene_.motion.materials.begin());
    move_to(0.75, scene_);
    update = world.update(scene_);
    EXPECT_EQ(update.changed_materials, 1u);
    EXPECT_EQ(update.uploaded_bytes, sizeof(MaterialRecord));
    move_to(0.75, scene_);
    EXPECT_EQ(world.update(scene_).changed_materials, 0u);
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

TEST_F(WorldUpdates, AreasAreFoundAnewOnlyWhereSurfacesChange) {
    RecordingDevice recording(device());
    World world(recording, scene_);
    RenderSettings settings = settings_of("photons", 8, 1);
    settings.photons = 1000;
    Session session(world, scene_, settings);
    const auto tables_of_frame = [&] {
        const auto before = recording.allocations();
        world.update(scene_);
        session.begin_frame(0);
        EXPECT_TRUE(
            same_bits(finish(session, [](double) { return true; }), render(scene_, settings)));
        const auto count = [](const std::map<std::string, std::uint64_t>& allocations) {
            const auto found = allocations.find("area sums");
            return found != allocations.end() ? found->second : 0;
        };
        return count(recording.allocations()) - count(before);
    };
    EXPECT_EQ(tables_of_frame(), 1u);
    EXPECT_EQ(tables_of_frame(), 0u);
    scene_.lights.back().position.x += 0.1f;
    scene_.cameras[0].position.x += 0.1f;
    EXPECT_EQ(tables_of_frame(), 0u);
    move_to(0.3, scene_);
    EXPECT_EQ(tables_of_frame(), 1u);
    scene_.materials[0].base_color = glm::vec3(0.3f); // as KHR_animation_pointer does
    EXPECT_EQ(tables_of_frame(), 1u);
    EXPECT_EQ(tables_of_frame(), 0u);
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
