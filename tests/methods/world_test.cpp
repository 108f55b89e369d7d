// A scene that moves on a device: each moment has the picture of a world that is built for it.
#include "moving_scene.hpp"
#include "rendering.hpp"
#include "support/recording_device.hpp"
#include "world/world.hpp"

#include <cmath>

namespace argand::testing {
namespace {

RenderResult render_in(World& world, const Scene& scene, const RenderSettings& settings) {
    return argand::render(world, scene, settings, [](double) { return true; });
}

/// Spoils the vertices on the host that move: nothing may read them where a device places them.
void forget_vertices(Scene& scene) {
    for (const MovingMesh& mesh : scene.motion.meshes) {
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            scene.positions[mesh.first_vertex + v] = glm::vec3(std::nanf(""));
            scene.normals[mesh.first_vertex + v] = glm::vec3(0);
        }
    }
}

/// moving_scene(), one of whose meshes has this material.
Scene moving_scene_of(const Material& material, std::size_t mesh, std::uint32_t triangles = 50) {
    Scene scene = moving_scene(triangles);
    const auto index = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(material);
    const MovingMesh& moving = scene.motion.meshes[mesh];
    for (std::size_t i = 0; i < moving.triangles; ++i) {
        scene.triangle_material[moving.first_triangle + i] = index;
    }
    return scene;
}

class MovingWorld : public EveryMethod {
protected:
    void expect_pictures_of_fresh_worlds(Scene scene) {
        RenderSettings settings = settings_of(GetParam(), 16, 2);
        settings.photons = 5'000;
        World world(device(), scene);
        Scene moving = scene;
        forget_vertices(moving);
        RenderResult before;
        for (const double time : {0.0, 0.25, 1.0, 0.5, 0.0}) {
            move_without_vertices(time, moving);
            world.update(moving);
            const RenderResult result = render_in(world, moving, settings);
            move_to(time, scene);
            EXPECT_TRUE(same_bits(result, render(scene, settings))) << time;
            EXPECT_FALSE(same_bits(result, before)) << time;
            before = result;
        }
    }
};

TEST_P(MovingWorld, EveryMomentHasThePictureOfAFreshWorld) {
    expect_pictures_of_fresh_worlds(moving_scene());
}

TEST_P(MovingWorld, MovingSurfacesMayShine) {
    Material lamp;
    lamp.emission = glm::vec3(3, 2, 1);
    expect_pictures_of_fresh_worlds(moving_scene_of(lamp, 0));
}

TEST_P(MovingWorld, MovingSurfacesMayCastCaustics) {
    Material glass;
    glass.metallic = glass.roughness = 0;
    glass.transmission = glass.thickness = 1;
    expect_pictures_of_fresh_worlds(moving_scene_of(glass, 1));
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
        EXPECT_EQ(update.moved.size(), 0u);
        EXPECT_EQ(update.uploaded_bytes, 0u);
        EXPECT_FALSE(update.refitted || update.rebuilt);
        EXPECT_EQ(recording.runs_of("ray_refit"), 1u);
    };
    expect_nothing();
    // Lights and cameras belong to a render.
    scene_.lights.back().position.x += 1;
    scene_.cameras[0].position.x += 0.1f;
    expect_nothing();
    // One of two meshes: the matrices of both nodes, but no vertex.
    scene_.motion.nodes[1].keys = {};
    scene_.motion.nodes[1].rest.scale = glm::dvec3(0.5);
    move_to(0.3, scene_);
    WorldUpdate update = world.update(scene_);
    EXPECT_EQ(update.moved.size(), 1u);
    EXPECT_EQ(update.uploaded_bytes, 2 * sizeof(PoseMatrix));
    EXPECT_TRUE(update.refitted);
    EXPECT_EQ(recording.runs_of("ray_refit"), 2u);
    EXPECT_EQ(recording.runs_of("lbvh_codes"), 1u);
    // Mirrored: the matrices and its triangles.
    scene_.motion.nodes[1].rest.scale.x *= -1;
    move_to(0.3, scene_);
    const std::uint64_t uploaded = recording.uploaded_bytes();
    update = world.update(scene_);
    const MovingMesh& mirrored = scene_.motion.meshes[1];
    EXPECT_EQ(update.moved.size(), 1u);
    EXPECT_EQ(update.turned_meshes, 1u);
    EXPECT_EQ(update.uploaded_bytes, 2 * sizeof(PoseMatrix) + 16 * mirrored.triangles);
    EXPECT_EQ(recording.uploaded_bytes() - uploaded, update.uploaded_bytes);
    EXPECT_EQ(recording.runs_of("pose_vertices"), 3u); // the first at the constructor
}

Bounds box_of(const Scene& scene, const MovingMesh& mesh) {
    Bounds box;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        box.low = glm::min(box.low, scene.positions[mesh.first_vertex + i]);
        box.high = glm::max(box.high, scene.positions[mesh.first_vertex + i]);
    }
    return box;
}

void expect_near(const Bounds& a, const Bounds& b) {
    EXPECT_LE(glm::distance(a.low, b.low), 1e-6f);
    EXPECT_LE(glm::distance(a.high, b.high), 1e-6f);
}

TEST_F(WorldUpdates, TellWhereMovedMeshesWereAndAre) {
    World world(device(), scene_);
    for (const double time : {0.25, 1.0, 0.5}) {
        const Scene before = scene_;
        move_to(time, scene_);
        const WorldUpdate update = world.update(scene_);
        ASSERT_EQ(update.moved.size(), 2u);
        for (std::size_t i = 0; i < 2; ++i) {
            const MovingMesh& mesh = scene_.motion.meshes[i];
            EXPECT_EQ(update.moved[i].mesh, i);
            expect_near(update.moved[i].before, box_of(before, mesh));
            expect_near(update.moved[i].after, box_of(scene_, mesh));
        }
    }
}

TEST_F(WorldUpdates, RefusePositionsThatAreNotFinite) {
    World world(device(), scene_);
    scene_.motion.nodes[1].keys.scale = between({1, 1, 1}, {1e39, 1, 1});
    move_without_vertices(1, scene_);
    try {
        world.update(scene_);
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "posing 'moving': a vertex of fan has a position that is not "
                                   "finite in world space");
    }
}

// Lavapipe ends loops after 65,535 iterations, and a part has 512 vertices.
TEST_F(WorldUpdates, PoseMeshesOfAnySize) {
    for (const std::uint32_t triangles : {1u, 509u, 510u, 511u, 70'001u}) {
        SCOPED_TRACE(triangles);
        scene_ = moving_scene(triangles);
        World world(device(), scene_);
        move_to(0.75, scene_);
        const WorldUpdate update = world.update(scene_);
        ASSERT_EQ(update.moved.size(), 2u);
        for (std::size_t i = 0; i < 2; ++i) {
            expect_near(update.moved[i].after, box_of(scene_, scene_.motion.meshes[i]));
        }
    }
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
    EXPECT_GT(world.tree_cost(), 1);
    EXPECT_LT(world.tree_cost(), 1.15);
    move_to(1, scene_);
    update = world.update(scene_);
    EXPECT_FALSE(update.refitted);
    EXPECT_TRUE(update.rebuilt);
    EXPECT_EQ(world.tree_cost(), 1);
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

/// What a later frame of moving_scene() with so many triangles in a mesh takes from the device and
/// brings there, by `photons`.
struct Transfers {
    std::uint64_t uploaded = 0;
    std::uint64_t vertices = 0; ///< bytes of vertices that the host fetched
    std::uint64_t lights = 0;   ///< bytes of sums of lights that it fetched
};
class Transferred : public RenderTest {
protected:
    Transfers of(Scene scene) {
        RecordingDevice recording(device());
        World world(recording, scene);
        RenderSettings settings = settings_of("photons", 8, 1);
        settings.photons = 1000;
        Session session(world, scene, settings);
        Transfers before;
        Transfers frame;
        for (const double time : {0.0, 0.25, 0.5}) {
            move_to(time, scene);
            world.update(scene);
            session.begin_frame(0);
            finish(session, [](double) { return true; });
            const Transfers now{recording.uploaded_bytes(), recording.downloaded_bytes("positions"),
                                recording.downloaded_bytes("sums of emissive parts")};
            frame = {now.uploaded - before.uploaded, now.vertices - before.vertices,
                     now.lights - before.lights};
            before = now;
        }
        return frame;
    }
};

TEST_F(Transferred, FramesBringNothingForATriangle) {
    const Transfers few = of(moving_scene(50));
    const Transfers many = of(moving_scene(5'000));
    EXPECT_EQ(few.vertices, 0u);
    EXPECT_EQ(many.vertices, 0u);
    EXPECT_EQ(few.uploaded, many.uploaded);
}

TEST_F(Transferred, FramesFetchNoCasterOfCaustics) {
    Material glass;
    glass.metallic = glass.roughness = 0;
    glass.transmission = glass.thickness = 1;
    EXPECT_EQ(of(moving_scene_of(glass, 1)).vertices, 0u);
}

// A part of 128 of their triangles has a row in the tables by which lights are chosen.
TEST_F(Transferred, FramesBringNothingForATriangleThatShines) {
    Material lamp;
    lamp.emission = glm::vec3(3, 2, 1);
    const Transfers few = of(moving_scene_of(lamp, 0, 128));
    const Transfers many = of(moving_scene_of(lamp, 0, 12'800));
    EXPECT_EQ(few.vertices, 0u);
    EXPECT_EQ(many.vertices, 0u);
    EXPECT_GT(few.lights, 0u);
    EXPECT_EQ(many.lights, 100 * few.lights);
    EXPECT_LT(many.lights + many.uploaded - few.uploaded, 12'800u);
}

/// moving_scene() with a lamp of so many triangles that stands still under its ceiling.
Scene moving_scene_under_lamp(std::uint32_t triangles) {
    Scene scene = moving_scene();
    const auto material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.emplace_back().emission = glm::vec3(3, 2, 1);
    const auto place = [&](std::uint32_t i) {
        return static_cast<float>(i) / static_cast<float>(triangles) - 0.5f;
    };
    for (std::uint32_t i = 0; i < triangles; ++i) { // each has a corner of the one before
        const auto first = static_cast<std::uint32_t>(scene.positions.size());
        for (const glm::vec3 corner :
             {glm::vec3(place(i), 0.9f, 0), glm::vec3(place(i + 1), 0.9f, 0),
              glm::vec3(place(i), 0.9f, 0.5f)}) {
            scene.positions.push_back(corner);
            scene.normals.emplace_back(0);
        }
        scene.triangles.emplace_back(first, first + 1, first + 2);
        scene.triangle_material.push_back(material);
    }
    return scene;
}

TEST_F(Transferred, FramesBringNothingForATriangleThatShinesAtRest) {
    const Transfers few = of(moving_scene_under_lamp(512));
    const Transfers many = of(moving_scene_under_lamp(12'800));
    EXPECT_GT(few.lights, 0u);
    EXPECT_EQ(many.lights, 25 * few.lights); // a sum for each part of 128 triangles
    EXPECT_LT(many.lights + many.uploaded - few.uploaded, 12'800u);
}

// The host makes the lights of the same triangles at rest.
TEST_F(Transferred, MovingLampsLightTheSceneAsThoseAtRest) {
    Material lamp;
    lamp.emission = glm::vec3(3, 2, 1);
    for (const char* method : {"path", "photons"}) {
        SCOPED_TRACE(method);
        Scene moving = moving_scene_of(lamp, 0);
        move_to(0.5, moving);
        Scene resting = moving;
        resting.motion = {};
        RenderSettings settings = settings_of(method, 24, 64);
        settings.photons = 20'000;
        const RenderResult a = render(moving, settings);
        const RenderResult b = render(resting, settings);
        EXPECT_LT(compare(a.layers[0].image, b.layers[0].image).rel_mse, 1e-4);
    }
}

/// What a frame has run and uploaded.
struct FrameWork {
    std::uint64_t poses, refits, builds, areas, lights, uploaded, downloaded_vertices;
};

// Each change costs what depends on it, and no more: lights belong to a render, the rest to a
// world.
TEST_F(WorldUpdates, FramesDoOnlyWhatTheirChangesRequire) {
    Material lamp;
    lamp.emission = glm::vec3(3, 2, 1);
    scene_ = moving_scene_of(lamp, 0, 2'000);
    RecordingDevice recording(device());
    World world(recording, scene_);
    RenderSettings settings = settings_of("photons", 8, 1);
    settings.photons = 1000;
    Session session(world, scene_, settings);
    const auto counts = [&] {
        return FrameWork{
            recording.runs_of("pose_vertices"),     recording.runs_of("ray_refit"),
            recording.runs_of("lbvh_codes"),        recording.runs_of("area_triangles"),
            recording.runs_of("emissive_lights"),   recording.uploaded_bytes(),
            recording.downloaded_bytes("positions")};
    };
    const auto frame = [&] {
        const FrameWork before = counts();
        world.update(scene_);
        session.begin_frame(0);
        finish(session, [](double) { return true; });
        const FrameWork now = counts();
        EXPECT_EQ(now.lights - before.lights, 1u);
        EXPECT_EQ(now.downloaded_vertices, 0u);
        return FrameWork{now.poses - before.poses,
                         now.refits - before.refits,
                         now.builds - before.builds,
                         now.areas - before.areas,
                         now.lights - before.lights,
                         now.uploaded - before.uploaded,
                         0};
    };
    const auto expect_world = [](const FrameWork& work, std::uint64_t updates) {
        EXPECT_EQ(work.poses, updates);
        EXPECT_EQ(work.refits, updates);
        EXPECT_EQ(work.areas, updates);
    };
    move_to(0.25, scene_);
    frame();
    const FrameWork nothing = frame();
    expect_world(nothing, 0);
    scene_.cameras[0].position.x += 0.01f;
    const FrameWork camera = frame();
    expect_world(camera, 0);
    EXPECT_EQ(camera.builds, nothing.builds); // those of the photon map
    EXPECT_EQ(camera.uploaded, nothing.uploaded);
    scene_.lights.back().position.x += 0.01f;
    const FrameWork light = frame();
    expect_world(light, 0);
    EXPECT_EQ(light.uploaded, nothing.uploaded);
    scene_.motion.nodes[1].keys = {};
    scene_.motion.nodes[1].rest.scale = glm::dvec3(0.4);
    const FrameWork object = frame();
    expect_world(object, 1);
    const std::uint64_t moves = // matrices, and for each material whether it stores photons
        2 * sizeof(PoseMatrix) + scene_.materials.size() * sizeof(std::uint32_t);
    EXPECT_EQ(object.uploaded - nothing.uploaded, moves);
    move_to(0.26, scene_);
    scene_.cameras[0].position.x += 0.01f;
    scene_.materials[1].base_color = glm::vec3(0.3f);
    const FrameWork everything = frame();
    expect_world(everything, 1);
    EXPECT_EQ(everything.uploaded - nothing.uploaded, moves + sizeof(MaterialRecord));
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
