#include "scene/gltf.hpp"
#include "scene/pose.hpp"
#include "support/scratch_directory.hpp"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

using namespace argand;
using namespace argand::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(ARGAND_SOURCE_DIR) / "assets";

struct Expected {
    std::string file;
    std::size_t triangles, materials, emitters, lights;
};

const std::vector<Expected> scenes = {
    {"cornell_point.glb", 34, 7, 0, 1},
    {"cornell_area.glb", 42, 11, 1, 0},
    {"cornell_glass.glb", 2910, 11, 1, 0},
    {"frosted_glass.glb", 2912, 12, 1, 0},
    {"cornell_mirror.glb", 42, 11, 1, 0},
    {"ring.glb", 3842, 2, 0, 1},
    {"glossy.glb", 2910, 11, 1, 0},
    {"veil.glb", 44, 12, 1, 0},
    {"textures.glb", 1292, 7, 1, 0},
    {"spot.glb", 34, 7, 0, 1},
    {"cutouts.glb", 26, 8, 0, 1},
    {"tinted_glass.glb", 5790, 12, 1, 0},
    {"drink.glb", 2090, 14, 1, 0},
    {"varnish.glb", 8030, 14, 1, 0},
    {"sky_room.glb", 34, 7, 0, 0},
    {"courtyard.glb", 92, 6, 0, 1},
    {"smooth_sphere.glb", 98, 10, 1, 0},
    {"inside_glass.glb", 2922, 12, 1, 0},
    {"plane_point.gltf", 2, 1, 0, 1},
    {"closed_box.gltf", 12, 1, 1, 0},
    {"furnace.glb", 2880, 1, 0, 0},
    {"closed_room.glb", 26, 3, 1, 0},
    {"sunlit_ground.glb", 40, 5, 1, 1},
    {"forty_rooms.glb", 1040, 3, 1, 0},
    {"forty_bulbs.glb", 173760, 5, 1, 0},
    {"two_rooms.glb", 40, 5, 2, 0},
    {"window_room.glb", 58, 5, 0, 1},
    {"glazed_room.glb", 60, 6, 0, 1},
    {"blind.glb", 756, 7, 1, 1},
    {"glass_marble.glb", 2906, 4, 1, 0},
    {"marble_box.glb", 2906, 4, 1, 0},
    {"bulb.glb", 4344, 5, 1, 0},
    {"small_emitters.glb", 2072, 10, 8, 0},
    {"dark_room.glb", 26, 3, 1, 0},
    {"gloss_only.glb", 26, 3, 1, 0},
    {"shuffled_walls.glb", 4122, 11, 1, 0},
    {"moving_light.glb", 2902, 7, 0, 1},
    {"dynamic_shi.glb", 1316, 4, 0, 1},
    {"dynamic_slow_light.glb", 36, 8, 1, 0},
    {"dynamic_switch.glb", 28, 4, 2, 0},
    {"dynamic_block.glb", 46, 8, 0, 1},
    {"dynamic_occluder.glb", 7696, 5, 1, 0},
    {"dynamic_water.glb", 2062, 3, 1, 0},
    {"dynamic_camera.glb", 36, 8, 1, 0},
};

std::set<std::string> scene_files(const fs::path& where) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(where)) {
        if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf") {
            names.insert(entry.path().filename().string());
        }
    }
    return names;
}

class Asset : public ::testing::TestWithParam<Expected> {};

TEST_P(Asset, LoadsAsItIsMeant) {
    const Expected& expected = GetParam();
    const Scene scene = load_gltf(folder / expected.file);
    EXPECT_EQ(scene.triangles.size(), expected.triangles);
    EXPECT_EQ(scene.materials.size(), expected.materials);
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count_if(scene.materials, emits)),
              expected.emitters);
    EXPECT_EQ(scene.lights.size(), expected.lights);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "camera");
    EXPECT_EQ(scene.cameras[0].aspect, 1);
    if (expected.lights + expected.emitters > 0) {
        EXPECT_THAT(scene.notes, IsEmpty());
        EXPECT_FALSE(scene.environment.has_value());
    } else {
        EXPECT_THAT(scene.notes, ElementsAre(HasSubstr("studio")));
        EXPECT_TRUE(scene.environment.has_value());
    }
}

TEST_P(Asset, HasNoTriangleWithoutArea) {
    const Scene scene = load_gltf(folder / GetParam().file);
    for (const glm::uvec3& t : scene.triangles) {
        const glm::vec3 edge = scene.positions[t.y] - scene.positions[t.x];
        const glm::vec3 other = scene.positions[t.z] - scene.positions[t.x];
        EXPECT_GT(glm::length(glm::cross(edge, other)), 1e-3f * glm::dot(edge, edge));
        EXPECT_GT(glm::dot(edge, edge), 1e-7f);
    }
}

INSTANTIATE_TEST_SUITE_P(Assets, Asset, ::testing::ValuesIn(scenes), [](const auto& instance) {
    return instance.param.file.substr(0, instance.param.file.find('.'));
});

const Material& material_of(const Scene& scene, const std::string& name) {
    const auto found = std::ranges::find(scene.materials, name, &Material::name);
    EXPECT_NE(found, scene.materials.end()) << name;
    return *found;
}

/// Volume that the triangles of a material enclose, positive if they face outwards (divergence
/// theorem).
double volume(const Scene& scene, const std::string& name) {
    double sum = 0;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        if (scene.materials[scene.triangle_material[i]].name == name) {
            const glm::uvec3& t = scene.triangles[i];
            const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]),
                c(scene.positions[t.z]);
            sum += glm::dot(a, glm::cross(b, c)) / 6;
        }
    }
    return sum;
}

TEST(Assets, AllAreExpectedAndSmall) {
    std::set<std::string> expected;
    for (const Expected& scene : scenes) {
        expected.insert(scene.file);
        EXPECT_LT(fs::file_size(folder / scene.file), 200'000u) << scene.file;
    }
    EXPECT_EQ(scene_files(folder), expected);
}

TEST(Assets, BodiesFaceOutwardsAndRoomsInwards) {
    constexpr double pi = 3.14159265358979;
    EXPECT_NEAR(volume(load_gltf(folder / "cornell_area.glb"), "tall box"), 0.6 * 0.6 * 1.21, 1e-5);
    EXPECT_NEAR(volume(load_gltf(folder / "cornell_mirror.glb"), "mirror"), 0.6 * 0.6 * 1.21, 1e-5);
    EXPECT_NEAR(volume(load_gltf(folder / "cornell_glass.glb"), "glass sphere") /
                    (4 * pi / 3 * 0.064),
                1, 0.005);
    EXPECT_NEAR(volume(load_gltf(folder / "closed_box.gltf"), "walls"), -8, 1e-5);
    // A ring with rounded corners, of mean radius 1.04, 0.08 thick and 0.46 high (Pappus).
    const double section = 0.08 * 0.46 - (4 - pi) * 0.025 * 0.025;
    EXPECT_NEAR(volume(load_gltf(folder / "ring.glb"), "ring") / (2 * pi * 1.04 * section), 1,
                0.005);
}

double area(const Scene& scene, const std::string& name) {
    double sum = 0;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        if (scene.materials[scene.triangle_material[i]].name == name) {
            sum += argand::area(scene, i);
        }
    }
    return sum;
}

Scene scene_at_frame(const std::string& file, int frame) {
    Scene scene = load_gltf(folder / file);
    move_to(frame / 24.0, scene);
    return scene;
}

TEST(Assets, InterpolatedNormalsFaceAsTheirTriangles) {
    for (const char* file : {"cornell_glass.glb", "ring.glb", "smooth_sphere.glb"}) {
        const Scene scene = load_gltf(folder / file);
        std::size_t smooth = 0;
        for (const glm::uvec3& t : scene.triangles) {
            const glm::vec3 edge = scene.positions[t.y] - scene.positions[t.x];
            const glm::vec3 face = glm::cross(edge, scene.positions[t.z] - scene.positions[t.x]);
            for (int corner = 0; corner < 3; ++corner) {
                const glm::vec3 normal = scene.normals[t[corner]];
                if (normal != glm::vec3(0)) {
                    EXPECT_GT(glm::dot(normal, face), 0) << file;
                    smooth += glm::distance(normal, glm::normalize(face)) > 1e-3f;
                }
            }
        }
        EXPECT_GT(smooth, 100u) << file;
    }
}

TEST(Assets, MaterialsAreWhatTheirNamesSay) {
    const Scene glass = load_gltf(folder / "cornell_glass.glb");
    EXPECT_EQ(material_of(glass, "glass sphere").transmission, 1);
    EXPECT_EQ(material_of(glass, "glass sphere").ior, 1.5f);
    EXPECT_EQ(material_of(glass, "glass sphere").roughness, 0);
    EXPECT_GT(material_of(glass, "glass sphere").thickness, 0);
    EXPECT_EQ(material_of(glass, "floor").specular, 0);
    EXPECT_EQ(material_of(glass, "floor").metallic, 0);

    const Scene veil = load_gltf(folder / "veil.glb");
    EXPECT_EQ(material_of(veil, "pane").coverage, 0.4f);
    ASSERT_TRUE(material_of(veil, "plastic box").phong.has_value());
    EXPECT_EQ(material_of(veil, "plastic box").phong->exponent, 60);

    const Scene mirror = load_gltf(folder / "cornell_mirror.glb");
    EXPECT_EQ(material_of(mirror, "mirror").metallic, 1);
    EXPECT_EQ(material_of(mirror, "mirror").roughness, 0);

    const Scene closed = load_gltf(folder / "closed_box.gltf");
    EXPECT_EQ(closed.materials[0].emission, glm::vec3(0.25f));
    EXPECT_EQ(closed.materials[0].base_color, glm::vec3(0.5f));
}

TEST(Assets, LightsStandWhereTheyShould) {
    const Light point = load_gltf(folder / "plane_point.gltf").lights.at(0);
    EXPECT_EQ(point.kind, LightKind::point);
    EXPECT_EQ(point.position, glm::vec3(0, 1, 0));
    EXPECT_EQ(point.intensity, glm::vec3(2));

    const Light spot = load_gltf(folder / "spot.glb").lights.at(0);
    EXPECT_EQ(spot.kind, LightKind::spot);
    EXPECT_NEAR(glm::distance(spot.direction, glm::normalize(glm::vec3(-0.9f, -1.3f, -0.35f))), 0,
                1e-5);

    const Light sun = load_gltf(folder / "courtyard.glb").lights.at(0);
    EXPECT_EQ(sun.kind, LightKind::directional);
    EXPECT_NEAR(glm::distance(sun.direction, glm::normalize(glm::vec3(-0.55f, -1, -0.5f))), 0,
                1e-5);
}

TEST(Assets, CamerasLookAtTheirScenes) {
    const Camera front = load_gltf(folder / "cornell_area.glb").cameras[0];
    EXPECT_NEAR(glm::distance(front.forward, glm::vec3(0, 0, -1)), 0, 1e-6);
    EXPECT_NEAR(glm::distance(front.up, glm::vec3(0, 1, 0)), 0, 1e-6);
    EXPECT_NEAR(front.vertical_angle, 0.6981317f, 1e-6);
    const Camera above = load_gltf(folder / "plane_point.gltf").cameras[0];
    EXPECT_NEAR(glm::distance(above.forward, glm::vec3(0, -1, 0)), 0, 1e-6);
    EXPECT_NEAR(glm::distance(above.up, glm::vec3(0, 0, -1)), 0, 1e-6);
    const Camera slanted = load_gltf(folder / "ring.glb").cameras[0];
    EXPECT_NEAR(glm::distance(slanted.forward, glm::normalize(glm::vec3(0, -4, -2.2f))), 0, 1e-6);
}

TEST(Assets, LightOfShiGoesAndComesBack) {
    const std::vector<glm::vec3> places = {{-6, 10, 6}, {-2, 10, 2}, {2, 10, -2}, {6, 10, -6},
                                           {2, 10, -2}, {-2, 10, 2}, {-6, 10, 6}};
    for (int frame = 0; frame < 7; ++frame) {
        const Light light = scene_at_frame("dynamic_shi.glb", frame).lights.at(0);
        EXPECT_NEAR(glm::distance(light.position, places[std::size_t(frame)]), 0, 1e-5) << frame;
    }
}

TEST(Assets, SwitchedLampIsOffForFourFrames) {
    for (int frame = 0; frame < 12; ++frame) {
        const Scene scene = scene_at_frame("dynamic_switch.glb", frame);
        EXPECT_NEAR(area(scene, "switched lamp"), frame < 4 || frame > 7 ? 0.16 : 0, 1e-6) << frame;
        EXPECT_NEAR(area(scene, "lamp"), 0.36, 1e-6) << frame;
    }
}

TEST(Assets, WavesKeepTheirNormalsAndHeights) {
    for (int frame = 0; frame < 16; ++frame) {
        const Scene scene = scene_at_frame("dynamic_water.glb", frame);
        for (const glm::uvec3& t : scene.triangles) {
            const glm::vec3 edge = scene.positions[t.y] - scene.positions[t.x];
            const glm::vec3 face = glm::cross(edge, scene.positions[t.z] - scene.positions[t.x]);
            for (int corner = 0; corner < 3; ++corner) {
                if (scene.normals[t[corner]] != glm::vec3(0)) {
                    EXPECT_GT(glm::dot(scene.normals[t[corner]], glm::normalize(face)), 0.95f);
                    EXPECT_LT(std::abs(scene.positions[t[corner]].y), 0.026f);
                }
            }
        }
    }
}

TEST(Assets, CameraFliesIntoTheBox) {
    for (int frame = 0; frame < 16; ++frame) {
        const Camera camera = scene_at_frame("dynamic_camera.glb", frame).cameras.at(0);
        const glm::vec3 target(0, 0.8f, -0.4f);
        EXPECT_NEAR(glm::distance(camera.forward, glm::normalize(target - camera.position)), 0,
                    1e-5)
            << frame;
        EXPECT_NEAR(camera.position.z, 2.9 - 0.13 * frame, 1e-5) << frame;
    }
}

TEST(Assets, AreWhatTheScriptWrites) {
    if (std::system("python3 --version >/dev/null 2>&1") != 0) {
        GTEST_SKIP() << "python3 is not installed; the other tests check the scenes themselves";
    }
    const ScratchDirectory scratch;
    const std::string command = "python3 -B '" + (folder / "make_scenes.py").string() + "' '" +
                                scratch.path().string() + "'";
    ASSERT_EQ(std::system(command.c_str()), 0);
    ASSERT_EQ(scene_files(scratch.path()), scene_files(folder));
    for (const std::string& name : scene_files(folder)) {
        // EXPECT_EQ would print both.
        EXPECT_TRUE(read_text(scratch / name) == read_text(folder / name))
            << name << ": run assets/make_scenes.py";
    }
}

} // namespace
