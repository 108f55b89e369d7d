// The lights that a device makes of emissive triangles that move, against the table that the host
// makes of the scene at that moment.
#include "world/emissive_parts.hpp"

#include "device_fixture.hpp"
#include "methods/moving_scene.hpp"
#include "methods/textured.hpp"
#include "scene/pose.hpp"
#include "world/connected_triangles.hpp"
#include "world/world.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

namespace argand::testing {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

/// moving_scene(), both of whose fans shine, one of them from both sides, with a lamp at rest
/// beside its point lights, and a sky.
Scene shining_fans(std::uint32_t triangles) {
    Scene scene = moving_scene(triangles);
    Material two_sided = emitter({3, 2, 1});
    two_sided.double_sided = true;
    const std::uint32_t materials[2] = {add_material(scene, emitter({0.5f, 1, 2})),
                                        add_material(scene, two_sided)};
    for (std::size_t i = 0; i < 2; ++i) {
        const MovingMesh& mesh = scene.motion.meshes[i];
        std::fill_n(scene.triangle_material.begin() +
                        static_cast<std::ptrdiff_t>(mesh.first_triangle),
                    mesh.triangles, materials[i]);
    }
    add_quad(scene, {5, 5, 5}, {0.1f, 0, 0}, {0, 0.1f, 0}, materials[0]);
    scene.sky = glm::vec3(0.1f);
    return scene;
}

class EmissiveMeshes : public DeviceTest {
protected:
    /// The lights of a scene and the two tables for choosing one.
    struct Lights {
        LightTable table;
        std::vector<LightRecord> lights;
        std::vector<LightChoice> for_rays, for_photons;
    };
    Lights on_device(World& world, const Scene& scene) {
        const DeviceScene there = world.on_device(scene, make_plan(scene, {.everything = true}));
        EXPECT_NE(there.emissive, nullptr);
        const std::size_t count = there.light_table.light_count;
        return {there.light_table, download<LightRecord>(open(), there.lights, count),
                download<LightChoice>(open(), there.light_choices, count),
                download<LightChoice>(open(), there.light_choices, count, count)};
    }
    Lights on_device(const Scene& scene) {
        World world(open(), scene);
        return on_device(world, scene);
    }
};

LightTable on_host(const Scene& scene) {
    const Bounds box = bounds(scene);
    return make_light_table(scene, triangles_of(scene, which_emit(scene)), {},
                            0.50001f * glm::length(box.high - box.low));
}

void expect_near(const LightRecord& a, const LightRecord& b) {
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.triangle_and_sides, b.triangle_and_sides);
    EXPECT_EQ(glm::vec3(a.r, a.g, a.b), glm::vec3(b.r, b.g, b.b));
    EXPECT_LE(glm::distance(glm::vec3(a.x, a.y, a.z), glm::vec3(b.x, b.y, b.z)), 1e-6f);
    EXPECT_LE(glm::distance(glm::vec3(a.dx, a.dy, a.dz), glm::vec3(b.dx, b.dy, b.dz)), 1e-6f);
    EXPECT_LE(glm::distance(glm::vec3(a.ex, a.ey, a.ez), glm::vec3(b.ex, b.ey, b.ez)), 1e-6f);
}

/// The share of all random digits that choose a row of the table.
double chance_of(const std::vector<LightChoice>& choices, std::size_t i) {
    const double end = i + 1 < choices.size() ? choices[i + 1].before : 4294967296.0;
    return (end - choices[i].before) / 4294967296.0;
}

/// Each light is chosen as often as its row says, and about as often as by the host's table.
void expect_choices(const std::vector<LightChoice>& choices, const LightTable& host) {
    const std::vector<LightChoice> expected = light_choices(host, plain_shares(host));
    ASSERT_EQ(choices.size(), expected.size());
    for (std::size_t i = 0; i < choices.size(); ++i) {
        SCOPED_TRACE(i);
        ASSERT_NEAR(chance_of(choices, i), choices[i].probability,
                    1e-7 * chance_of(choices, i) + 5e-10);
        ASSERT_NEAR(choices[i].probability, expected[i].probability,
                    1e-4 * expected[i].probability + 1e-9);
        ASSERT_NEAR(choices[i].emitter_probability, expected[i].emitter_probability, 1e-6);
    }
}

// A part has 128 triangles, and lavapipe ends loops after 65,535 iterations.
TEST_F(EmissiveMeshes, HaveTheLightsOfTheHostsTableAtEveryMoment) {
    for (const std::uint32_t triangles : {1u, 127u, 128u, 129u, 70'001u}) {
        SCOPED_TRACE(triangles);
        Scene scene = shining_fans(triangles);
        World world(open(), scene);
        for (const double time : {0.0, 0.75, 0.25}) {
            move_to(time, scene);
            world.update(scene);
            const Lights found = on_device(world, scene);
            const LightTable host = on_host(scene);
            ASSERT_EQ(found.lights.size(), host.lights.size());
            EXPECT_EQ(found.table.first_triangle, host.first_triangle);
            EXPECT_EQ(found.table.triangle_count, host.triangle_count);
            for (std::size_t i = 0; i < found.lights.size(); ++i) {
                expect_near(found.lights[i], host.lights[i]);
                const std::size_t row = row_of(found.table, static_cast<std::uint32_t>(i));
                ASSERT_EQ(found.table.emitter[row], host.emitter[i]);
                ASSERT_EQ(found.table.lights[row].kind, host.lights[i].kind);
            }
            for (std::size_t i = 0; i < host.emitter_weights.size(); ++i) {
                EXPECT_NEAR(found.table.emitter_weights[i], host.emitter_weights[i],
                            1e-5 * host.emitter_weights[i]);
            }
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_NEAR(found.table.power[channel], host.power[channel],
                            1e-5 * host.power[channel]);
            }
            expect_choices(found.for_rays, host);
            expect_choices(found.for_photons, host);
        }
    }
}

TEST_F(EmissiveMeshes, ShineByTheirTexelsAtEveryMoment) {
    Scene scene = shining_fans(5);
    const std::uint32_t material = scene.triangle_material[scene.motion.meshes[1].first_triangle];
    add_texture(scene, material, material_emissive_texture, 1, {texel(188, 255, 0)}, false);
    scene.uvs.assign(scene.positions.size(), glm::vec2(0.3f));
    World world(open(), scene);
    for (const double time : {0.0, 0.75}) {
        scene.materials[material].emission = glm::vec3(3 + float(time), 2, 1);
        move_to(time, scene);
        world.update(scene);
        const Lights found = on_device(world, scene);
        LightTable host = on_host(scene); // without texels
        ASSERT_EQ(found.lights.size(), host.lights.size());
        int by_texels = 0;
        for (std::size_t i = 0; i < found.lights.size(); ++i) {
            LightRecord& expected = host.lights[i];
            const std::uint32_t triangle = expected.triangle_and_sides / 2;
            if (expected.kind == light_triangle && scene.triangle_material[triangle] == material) {
                expected.r *= float(linear(188));
                expected.b = 0;
                EXPECT_GE(found.lights[i].cos_inner, float(srgb_codes));
                EXPECT_FLOAT_EQ(found.lights[i].r, expected.r);
                expected.r = found.lights[i].r;
                ++by_texels;
            }
            expect_near(found.lights[i], expected);
        }
        EXPECT_EQ(by_texels, 5);
    }
}

TEST_F(EmissiveMeshes, OfBlackTexelsAreNoLights) {
    Scene scene = shining_fans(5);
    const std::uint32_t material = scene.triangle_material[scene.motion.meshes[1].first_triangle];
    add_texture(scene, material, material_emissive_texture, 1, {texel(0, 0, 0)}, false);
    scene.uvs.assign(scene.positions.size(), glm::vec2(0.3f));
    move_to(0.25, scene);
    const Lights found = on_device(scene);
    const auto is_triangle = [](const LightRecord& light) { return light.kind == light_triangle; };
    EXPECT_EQ(std::count_if(found.lights.begin(), found.lights.end(), is_triangle), 5 + 2);
    for (const LightRecord& light : found.lights) {
        EXPECT_FALSE(is_triangle(light) &&
                     scene.triangle_material[light.triangle_and_sides / 2] == material);
    }
}

TEST_F(EmissiveMeshes, MayAllBeBlack) {
    Scene scene = shining_fans(300);
    for (const MovingMesh& mesh : scene.motion.meshes) {
        add_texture(scene, scene.triangle_material[mesh.first_triangle], material_emissive_texture,
                    1, {texel(0, 0, 0)}, false);
    }
    scene.uvs.assign(scene.positions.size(), glm::vec2(0.3f));
    move_to(0.25, scene);
    for (const bool moves : {true, false}) {
        SCOPED_TRACE(moves);
        if (!moves) {
            scene.motion = {};
        }
        const Lights found = on_device(scene);
        EXPECT_EQ(found.table.triangle_count, 0u);
        ASSERT_EQ(found.lights.size(), scene.lights.size() + 1); // and the sky
        double sum = 0;
        for (const LightChoice& choice : found.for_rays) {
            sum += choice.probability;
        }
        EXPECT_NEAR(sum, 1, 1e-6);
    }
}

TEST_F(EmissiveMeshes, HaveTheLightsOfTheHostsTableWhereManyStandStill) {
    Scene scene = shining_fans(300);
    move_to(0.25, scene);
    scene.motion = {};
    const Lights found = on_device(scene);
    const LightTable host = on_host(scene);
    ASSERT_EQ(found.lights.size(), host.lights.size());
    for (std::size_t i = 0; i < host.lights.size(); ++i) {
        expect_near(found.lights[i], host.lights[i]);
    }
    expect_choices(found.for_rays, host);
    expect_choices(found.for_photons, host);
}

TEST_F(EmissiveMeshes, StandAtTheMiddleOfTheirParts) {
    Scene scene = shining_fans(300);
    move_to(0.25, scene);
    const Lights found = on_device(scene);
    const LightTable host = on_host(scene);
    std::vector<glm::dvec3> middle(found.table.lights.size(), glm::dvec3(0));
    for (std::uint32_t i = 0; i < host.lights.size(); ++i) {
        const LightRecord& l = host.lights[i];
        const std::size_t row = row_of(found.table, i);
        middle[row] += host.weights[i] / found.table.weights[row] / 3 *
                       glm::dvec3(double(l.x) + l.dx + l.ex, double(l.y) + l.dy + l.ey,
                                  double(l.z) + l.dz + l.ez);
    }
    for (std::size_t row = 0; row < middle.size(); ++row) {
        const LightRecord& l = found.table.lights[row];
        if (l.kind == light_triangle) {
            EXPECT_LE(glm::distance(middle[row], glm::dvec3(l.x, l.y, l.z)), 1e-5) << row;
        }
    }
}

// Their samples would be divided by a probability of 0.
TEST_F(EmissiveMeshes, WithoutAreaAreNeverChosen) {
    Scene scene = shining_fans(5);
    scene.motion.nodes[0].keys.scale = between({1, 1, 1}, {0, 0, 0});
    scene.motion.nodes[1].keys.scale = between({1, 1, 1}, {0, 0, 0});
    move_to(1, scene);
    const Lights found = on_device(scene);
    const LightTable host = on_host(scene);
    EXPECT_EQ(found.lights.size(), host.lights.size() + 10);
    for (std::size_t i = 0; i < found.lights.size(); ++i) {
        const std::size_t row = row_of(found.table, static_cast<std::uint32_t>(i));
        EXPECT_GT(found.for_rays[i].probability, 0) << i;
        const bool has_area = found.table.weights[row] > 0;
        EXPECT_EQ(chance_of(found.for_rays, i) > 0, has_area) << i;
    }
    EXPECT_THAT(plain_shares(found.table), ::testing::Contains(0).Times(2));
    double sum = 0;
    for (const double share : plain_shares(found.table)) {
        sum += share;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
}

TEST_F(EmissiveMeshes, MayAllBeWithoutArea) {
    Scene scene = moving_scene(5);
    scene.lights.clear();
    scene.motion.lights.clear();
    scene.materials[0].emission = glm::vec3(1); // of the walls as well
    std::fill_n(scene.triangle_material.begin(), scene.motion.meshes[0].first_triangle, 1u);
    scene.motion.nodes[0].keys.scale = scene.motion.nodes[1].keys.scale =
        between({1, 1, 1}, {0, 0, 0});
    move_to(1, scene);
    const Lights found = on_device(scene);
    EXPECT_EQ(found.lights.size(), 10u);
    EXPECT_THAT(plain_shares(found.table), Each(0));
    for (const LightChoice& choice : found.for_rays) {
        EXPECT_TRUE(std::isfinite(choice.probability) && choice.probability > 0);
    }
}

// Both fans have the same object space; the nodes take them to different places.
TEST_F(EmissiveMeshes, OfOneNodeAreOneEmitter) {
    Scene scene = shining_fans(7);
    scene.sky.reset();
    scene.lights.clear();
    scene.motion.lights.clear();
    move_to(0.5, scene);
    EXPECT_THAT(on_device(scene).table.emitter, ElementsAre(0, 1, 2));
    scene.motion.meshes[1].node = scene.motion.meshes[0].node;
    EXPECT_THAT(on_device(scene).table.emitter, ElementsAre(0, 1)); // and one part
}

TEST_F(EmissiveMeshes, ArePartsOnlyWhereTheyMove) {
    Scene scene = moving_scene(5);
    scene.materials[1].emission = glm::vec3(1); // a wall
    World world(open(), scene);
    EXPECT_EQ(world.on_device(scene, make_plan(scene, {})).emissive, nullptr);
    scene.materials[0].emission = glm::vec3(1); // that of the fans, too
    world.update(scene);
    EXPECT_NE(world.on_device(scene, make_plan(scene, {})).emissive, nullptr);
}

} // namespace
} // namespace argand::testing
