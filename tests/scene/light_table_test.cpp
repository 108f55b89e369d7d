#include "world/light_table.hpp"

#include "methods/scenes.hpp"
#include "world/connected_triangles.hpp"

#include <gmock/gmock.h>
#include <numeric>

namespace argand::testing {
namespace {

using ::testing::ElementsAre;

Light sun() {
    Light light;
    light.kind = LightKind::directional;
    light.direction = {0, -1, 0};
    light.intensity = glm::vec3(1e6f);
    return light;
}

/// A sun and two lamps of two triangles each, of which the second is thrice as large. The triangles
/// share positions but no vertices.
Scene sun_and_two_lamps() {
    Scene scene;
    scene.lights = {sun()};
    const std::uint32_t white = add_material(scene, lambertian(glm::vec3(0.5f)));
    const std::uint32_t lamp = add_material(scene, emitter(glm::vec3(1)));
    add_quad(scene, {0, 2, 0}, {1, 0, 0}, {0, 0, 1}, lamp);
    add_floor(scene, 1, 0, white);
    add_quad(scene, {5, 2, 0}, {3, 0, 0}, {0, 0, 1}, lamp);
    return scene;
}

LightTable table_of(const Scene& scene, float scene_radius) {
    return make_light_table(scene, triangles_of(scene, which_emit(scene)), {}, scene_radius);
}

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(LightTable, ConnectedTrianglesAreOneEmitter) {
    const LightTable table = table_of(sun_and_two_lamps(), 10);
    EXPECT_THAT(table.emitter, ElementsAre(0, 1, 1, 2, 2));
    EXPECT_EQ(table.first_triangle, 1u);
    EXPECT_EQ(table.triangle_count, 4u);
    EXPECT_NEAR(table.emitter_weights[1], pi, 1e-5);
    EXPECT_NEAR(table.emitter_weights[2], 3 * pi, 1e-5);
}

TEST(LightTable, CornersAtZeroAndMinusZeroAreTheSame) {
    Scene scene;
    const std::uint32_t lamp = add_material(scene, emitter(glm::vec3(1)));
    add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, lamp);
    add_triangle(scene, {-0.0f, 0, -0.0f}, {-1, 0, 0}, {-1, 1, 0}, lamp);
    EXPECT_THAT(table_of(scene, 10).emitter, ElementsAre(0, 0));
}

TEST(LightTable, LightsKnowTheirTriangles) {
    const LightTable table = table_of(sun_and_two_lamps(), 10);
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 0; i < table.triangle_count; ++i) {
        triangles.push_back(table.lights[table.first_triangle + i].triangle_and_sides >> 1);
    }
    EXPECT_THAT(triangles, ElementsAre(0, 1, 4, 5)); // the floor lies between
}

// A lamp is chosen although the sun has a million times its power.
TEST(LightTable, PlainSharesGiveEveryEmitterAPart) {
    const LightTable table = table_of(sun_and_two_lamps(), 10);
    const std::vector<double> shares = plain_shares(table);
    EXPECT_NEAR(sum_of(shares), 1, 1e-12);
    EXPECT_NEAR(shares[0], 0.5 + 0.5 / 3, 1e-6);
    EXPECT_NEAR(shares[1], 0.5 / 3, 1e-6);
    EXPECT_GT(shares[2], shares[1]);
}

TEST(LightTable, LightsWithoutPowerAreLeftOut) {
    Scene scene = sun_and_two_lamps();
    scene.lights[0].intensity = glm::vec3(0);
    scene.sky = glm::vec3(0);
    const std::uint32_t lamp = scene.triangle_material[0];
    add_triangle(scene, {0, 0, 0}, {1, 1, 1}, {1, 1, 1}, lamp); // without area
    const LightTable table = table_of(scene, 10);
    EXPECT_EQ(table.lights.size(), 4u);
    EXPECT_EQ(table.first_triangle, 0u);
    EXPECT_EQ(table.triangle_count, 4u);
    EXPECT_NEAR(sum_of(plain_shares(table)), 1, 1e-12);
}

TEST(LightTable, OneEmitterIsAlwaysChosen) {
    Scene scene = sun_and_two_lamps();
    scene.triangle_material.assign(scene.triangles.size(), 0);
    const LightTable table = table_of(scene, 10);
    EXPECT_THAT(plain_shares(table), ElementsAre(1));
    EXPECT_THAT(learnt_shares(table, {{0}, 0}), ElementsAre(1));
    EXPECT_THAT(learnt_shares(table, {{7}, 5}), ElementsAre(1));
}

TEST(LightTable, SceneWithoutLights) {
    const LightTable table = table_of(Scene(), 0);
    EXPECT_TRUE(plain_shares(table).empty());
    EXPECT_TRUE(learnt_shares(table, {{}, 0}).empty());
    EXPECT_TRUE(light_choices(table, {}).empty());
}

TEST(LightTable, LearntSharesPreferWhatWasFoundAndForgetNone) {
    const LightTable table = table_of(sun_and_two_lamps(), 10);
    const std::vector<double> plain = plain_shares(table);
    EXPECT_EQ(learnt_shares(table, {{0, 0, 0}, 10}), plain);
    const std::vector<double> few = learnt_shares(table, {{0, 3, 1}, 4});
    EXPECT_NEAR(few[0], (1 - 0.475) * plain[0], 1e-12);
    EXPECT_NEAR(few[1], (1 - 0.475) * plain[1] + 0.475 * 0.75, 1e-12);
    const std::vector<double> many = learnt_shares(table, {{0, 3, 1}, 1'000'000'000});
    EXPECT_NEAR(many[0], 0.05 * plain[0], 1e-6);
    EXPECT_NEAR(many[1], 0.05 * plain[1] + 0.95 * 0.75, 1e-6);
    EXPECT_NEAR(sum_of(many), 1, 1e-12);
}

// The probabilities of the table's rows are those with which the rows are chosen.
TEST(LightTable, ChoicesFollowTheShares) {
    Scene scene = sun_and_two_lamps();
    for (int i = 0; i < 100; ++i) { // a lamp of triangles of many sizes
        const auto x = static_cast<float>(i);
        add_triangle(scene, {20, 2, 0}, {20 + x * x, 2, 1 + x}, {20, 2, 1 + x}, 1);
    }
    const LightTable table = table_of(scene, 10);
    const std::vector<double> shares = learnt_shares(table, {{1, 2, 3, 4}, 100});
    const std::vector<LightChoice> choices = light_choices(table, shares);
    std::vector<double> of_emitter(shares.size(), 0.0);
    for (std::size_t i = 0; i < choices.size(); ++i) {
        const double end = i + 1 < choices.size() ? choices[i + 1].before : 4294967296.0;
        const double chosen = (end - choices[i].before) / 4294967296.0;
        EXPECT_NEAR(chosen, choices[i].probability, 1e-6 * chosen + 1e-9) << i;
        EXPECT_NEAR(choices[i].emitter_probability, shares[table.emitter[i]], 1e-6) << i;
        of_emitter[table.emitter[i]] += chosen;
    }
    for (std::size_t i = 0; i < shares.size(); ++i) {
        EXPECT_NEAR(of_emitter[i], shares[i], 1e-6) << i;
    }
}

} // namespace
} // namespace argand::testing
