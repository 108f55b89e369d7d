// Final gather agrees with the path tracer: it counts every path once, in the right layer.
#include "rendering.hpp"

namespace argand::testing {
namespace {

constexpr float wall_albedo = 0.6f;

/// A closed room of one material, lit by a square under its ceiling.
Scene lit_room() {
    Scene scene = box_scene(lambertian(glm::vec3(wall_albedo)));
    scene.name = "lit room";
    const std::uint32_t light = add_material(scene, emitter(glm::vec3(3), glm::vec3(0.5f)));
    add_quad(scene, {-0.5f, 0.9f, -0.5f}, {1, 0, 0}, {0, 0, 1}, light);
    scene.cameras = {look_at({0.2f, -0.1f, 0.9f}, {0, -0.3f, -1}, 70)};
    return scene;
}

/// The same room, with this material on most of the far wall.
Scene room_with_wall_of(const Material& material) {
    Scene scene = lit_room();
    add_quad(scene, {-0.8f, -0.8f, -0.95f}, {1.6f, 0, 0}, {0, 1.6f, 0},
             add_material(scene, material));
    return scene;
}

Scene mirror_room() {
    Scene scene = room_with_wall_of(mirror(glm::vec3(0.9f)));
    scene.name = "room with a mirror";
    return scene;
}

Scene glass_room() {
    Scene scene = lit_room();
    scene.name = "room with glass";
    add_box(scene, {-0.6f, -0.9f, -0.6f}, {0.3f, -0.3f, 0.2f},
            add_material(scene, glass(1.5f, true)), false);
    return scene;
}

/// A delta light, whose glossy reflection both methods find.
Scene glossy_room() {
    Scene scene = room_scene();
    scene.name = "room with gloss";
    Material metal = mirror(glm::vec3(0.9f));
    metal.roughness = 0.22f;
    add_quad(scene, {-0.8f, -0.8f, -0.95f}, {1.6f, 0, 0}, {0, 1.6f, 0}, add_material(scene, metal));
    return scene;
}

/// A lobe too rough to be followed, but so narrow that points sampled on the light seldom lie in
/// it.
Material narrow_gloss() {
    Material metal = mirror(glm::vec3(0.9f));
    metal.roughness = 0.3f;
    return metal;
}

Scene room_with_narrow_gloss() {
    Scene scene = room_with_wall_of(narrow_gloss());
    scene.name = "room with narrow gloss";
    return scene;
}

/// Diffuse and glossy with a coverage of one half: a path scatters from one lobe or passes through.
Scene room_with_half_a_plastic_wall() {
    Material plastic = lambertian(glm::vec3(0.5f));
    plastic.specular = 1;
    plastic.roughness = 0.3f;
    plastic.coverage = 0.5f;
    Scene scene = room_with_wall_of(plastic);
    scene.name = "room with half a plastic wall";
    return scene;
}

/// A floor under the sky with two walls, one of this material.
Scene yard(const Material& material) {
    Scene scene = floor_scene(lambertian(glm::vec3(wall_albedo)), 1);
    scene.name = material.roughness > 0 ? "yard with gloss" : "yard with a mirror";
    add_quad(scene, {-1, 0, -1}, {2, 0, 0}, {0, 1.5f, 0}, 0);
    add_quad(scene, {-1, 0, 1}, {0, 0, -2}, {0, 1.5f, 0}, add_material(scene, material));
    scene.sky = glm::vec3(0.5f, 0.8f, 1);
    scene.cameras = {look_at({1.5f, 1, 1.5f}, {-0.4f, 0.2f, -0.4f}, 40)};
    return scene;
}

class FinalGather : public RenderTest {
protected:
    /// Expects the path tracer's mean radiance in each layer, within `tolerance` times the mean of
    /// the whole image.
    void expect_as_path(const Scene& scene, const std::string& method = "photons",
                        double tolerance = 0.01, std::uint32_t bounces = RenderSettings().bounces) {
        RenderSettings settings = settings_of("path", 16, 768);
        settings.bounces = bounces;
        const RenderResult& expected =
            render_once(scene.name + ", bounces " + std::to_string(bounces), scene, settings);
        settings = settings_of(method, 16, 256);
        settings.bounces = bounces;
        settings.photons = 50'000;
        settings.final_gather = true;
        const RenderResult actual = render(scene, settings);
        const double of_all = mean(layer(expected, "")).g;
        for (const char* name : {"direct", "indirect", "caustic"}) {
            EXPECT_NEAR(mean(layer(actual, name)).g, mean(layer(expected, name)).g,
                        tolerance * of_all)
                << scene.name << ", " << method << ", " << name << ", bounces " << bounces;
        }
    }
};

TEST_F(FinalGather, EveryMethodWithAPhotonMap) {
    for (const char* method : {"photons", "footprints", "knn"}) {
        expect_as_path(room_scene(), method, 0.02);
    }
}

TEST_F(FinalGather, EmittersAreMetOnce) { expect_as_path(lit_room()); }

TEST_F(FinalGather, SlowSky) {
    expect_as_path(yard(mirror(glm::vec3(0.9f))));
    expect_as_path(yard(narrow_gloss()));
}

TEST_F(FinalGather, SlowCausticsOfAMirror) { expect_as_path(mirror_room(), "photons", 0.015); }

TEST_F(FinalGather, CausticsOfGlass) { expect_as_path(glass_room(), "photons", 0.015); }

TEST_F(FinalGather, SlowCausticsOfGlossFromALightWithoutExtent) {
    expect_as_path(glossy_room(), "photons", 0.015);
}

TEST_F(FinalGather, SlowEmittersInNarrowLobesAreMetOnce) {
    expect_as_path(room_with_narrow_gloss());
    expect_as_path(room_with_narrow_gloss(), "photons", 0.01, 1);
    expect_as_path(room_with_half_a_plastic_wall());
}

TEST_F(FinalGather, SlowNoBrightDotsOfEmittersInNarrowLobes) {
    const Scene scene = room_with_narrow_gloss();
    RenderSettings settings = settings_of("path", 32, 512);
    settings.bounces = 1; // only what the gather's own rays find
    const Image reference = layer(render(scene, settings), "indirect");
    settings.samples = 32;
    const double of_path = compare(layer(render(scene, settings), "indirect"), reference).rmse;
    settings.method = "photons";
    settings.final_gather = true;
    EXPECT_LT(compare(layer(render(scene, settings), "indirect"), reference).rmse, 1.2 * of_path);
}

TEST_F(FinalGather, SlowNoMoreBouncesThanAreAllowed) {
    for (const std::uint32_t bounces : {1u, 2u}) {
        expect_as_path(mirror_room(), "photons", 0.01, bounces);
    }
    expect_as_path(lit_room(), "footprints", 0.01, 2);
}

TEST_F(FinalGather, FirstBounceNeedsNoPhotons) {
    RenderSettings settings = settings_of("photons", 16, 64);
    settings.final_gather = true;
    settings.bounces = 1;
    settings.photons = 0;
    const double expected =
        mean(layer(render(room_scene(), settings_of("path", 16, 64)), "direct")).g;
    const RenderResult result = render(room_scene(), settings);
    EXPECT_RELATIVE(mean(layer(result, "direct")).g, expected, 0.02);
    EXPECT_GT(mean(layer(result, "indirect")).g, 0.05 * expected);
}

TEST_F(FinalGather, BlotchesOfFewPhotonsVanish) {
    // So few photons that the map alone shows each as a blotch. A final gather averages them.
    const Scene scene = room_scene();
    const Image reference = layer(render(scene, settings_of("path", 16, 1024)), "indirect");
    RenderSettings settings = settings_of("footprints", 16, 128);
    settings.photons = 1000;
    const double blotches = compare(layer(render(scene, settings), "indirect"), reference).rel_mse;
    settings.final_gather = true;
    const double gathered = compare(layer(render(scene, settings), "indirect"), reference).rel_mse;
    EXPECT_LT(gathered, 0.5 * blotches);
}

// Eye paths that look for query points were led by what the memory of estimates held before.
TEST_F(FinalGather, DoesNotDependOnUndefinedMemory) {
    const Scene scene = load_asset("closed_room.glb");
    RenderSettings settings = settings_of("photons", 16, 2);
    settings.photons = 2000;
    settings.final_gather = true;
    const auto rendered = [&](const std::string& poison) {
        const ScopedEnvironment setting("ARGAND_POISON", poison);
        return testing::render(open_anew(), scene, settings);
    };
    EXPECT_TRUE(same_bits(rendered("0"), rendered("1")));
}

} // namespace
} // namespace argand::testing
