// Surfaces with partial coverage (alpha): eye paths and photons continue through the rest of them.
#include "rendering.hpp"

#include <functional>

namespace argand::testing {
namespace {

Material with_alpha(Material material, float alpha) {
    material.coverage = alpha;
    return material;
}

class Alpha : public EveryMethod {
protected:
    RenderSettings settings(int size, std::uint32_t samples, std::uint64_t photons) const {
        RenderSettings s = settings_of(GetParam(), size, samples);
        s.photons = photons;
        return s;
    }
};

TEST_P(Alpha, MixesTheSurfaceWithWhatIsBehind) {
    for (const float degrees : {0.0f, 60.0f, 89.0f}) {
        Scene scene;
        const auto veil = add_material(scene, with_alpha(lambertian({0.5f, 0.2f, 0}), 0.25f));
        add_quad(scene, {-500, -50, 0}, {1000, 0, 0}, {0, 100, 0}, veil);
        add_quad(scene, {-500, -50, -1}, {1000, 0, 0}, {0, 100, 0}, veil);
        add_quad(scene, {-5000, -5000, -2}, {10000, 0, 0}, {0, 10000, 0},
                 add_material(scene, emitter({0, 1, 2})));
        scene.lights = {directional_light({0, 0, -1}, glm::vec3(4 * pi))};
        const glm::vec3 from(3 * std::tan(glm::radians(degrees)), 0, 3);
        const glm::dvec3 l = radiance(scene, settings(8, 512, 1000), from, {0, 0, 0}, "direct");
        // The emitter also lights the far sides of the veils, which the camera does not see. The
        // sun lights the second veil through the first.
        const double veils = 0.25 * 4 * (1 + 0.75 * 0.75);
        EXPECT_NEAR(l.r, 0.5 * veils, 0.01) << degrees;
        EXPECT_NEAR(l.g, 0.2 * veils + 0.75 * 0.75 * 1, 0.02) << degrees;
        EXPECT_NEAR(l.b, 0.75 * 0.75 * 2, 0.04) << degrees;
    }
}

/// A floor below black veils of coverage 0.25, which only take light away.
Scene veiled_floor(int veils, float half = 400) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 3);
    const auto black = add_material(scene, with_alpha(lambertian(glm::vec3(0)), 0.25f));
    for (int i = 0; i < veils; ++i) {
        add_floor(scene, half, 1 + 0.1f * float(i), black);
    }
    scene.cameras = {parallel_rays({0, 0.6f, 0.3f}, {0, 0, 0}, 0.1f)};
    return scene;
}

// Each veil lets three quarters of the light pass, which stays direct: no scattering is allowed.
TEST_P(Alpha, VeilsDimDirectLight) {
    struct Lamp {
        const char* name;
        double bare; // radiance of the floor without veils
        double tolerance;
        std::function<void(Scene&)> add;
    };
    const float height = 3, side = 0.4f;
    // An emitter of this size is nearly a point: its cosine and distance vary by 1 %.
    const double small_lamp = double(20 * side * side / (height * height)) * 0.5 / double(pi);
    const std::vector<Lamp> lamps = {
        {"sun", 0.5 / double(pi), 2e-6,
         [](Scene& s) {
             s.lights = {directional_light({0, -1, 0}, glm::vec3(1))};
         }},
        {"point", double(7 / (height * height)) * 0.5 / double(pi), 0.003,
         [&](Scene& s) {
             s.lights = {point_light({0, height, 0}, glm::vec3(7))};
         }},
        {"sky", 0.5 * 2, 0.03, [](Scene& s) { s.sky = glm::vec3(2); }},
        {"lamp", small_lamp, 0.03, [&](Scene& s) {
             add_quad(s, {-side / 2, height, -side / 2}, {side, 0, 0}, {0, 0, side},
                      add_material(s, emitter(glm::vec3(20))));
         }}};
    for (const Lamp& lamp : lamps) {
        for (const int veils : {0, 1, 4}) {
            SCOPED_TRACE(::testing::Message() << lamp.name << ", " << veils << " veils");
            Scene scene = veiled_floor(veils);
            lamp.add(scene);
            RenderSettings s = settings(8, 64, 2000);
            s.bounces = veils == 1 ? 0 : s.bounces;
            const RenderResult result = render(scene, s);
            EXPECT_RELATIVE(mean(layer(result, "direct")).g, lamp.bare * std::pow(0.75, veils),
                            lamp.tolerance);
            EXPECT_EQ(mean(layer(result, "caustic")).g, 0);
            EXPECT_EQ(mean(layer(result, "indirect")).g, 0);
        }
    }
}

// The light that shadow rays bring, and that a glossy lobe finds by chance, pass alike.
TEST_P(Alpha, VeilsDimWhatGlossReflects) {
    const auto floor_under = [&](int veils, const std::string& method) {
        Scene scene = veiled_floor(veils);
        scene.materials[0].metallic = 1;
        scene.materials[0].roughness = 0.4f;
        scene.materials[0].specular = 1;
        add_quad(scene, {-1, 3, -2}, {2, 0, 0}, {0, 0, 2},
                 add_material(scene, emitter(glm::vec3(5))));
        RenderSettings s = settings_of(method, 8, 256);
        s.photons = 2000;
        s.bounces = 0;
        return render(scene, s);
    };
    const double bare = mean(layer(floor_under(0, "path"), "direct")).g;
    const RenderResult result = floor_under(2, GetParam());
    EXPECT_GT(bare, 0.1);
    EXPECT_RELATIVE(mean(layer(result, "direct")).g, bare * 0.75 * 0.75, 0.02);
}

TEST_P(Alpha, GlassBehindItIsACaustic) {
    const auto caustic = [&](int veils) {
        Scene scene = veiled_floor(veils, 4);
        add_floor(scene, 4, 2, add_material(scene, glass(1.5f, false)));
        scene.lights = {directional_light({0, -1, 0}, glm::vec3(1))};
        scene.cameras = {parallel_rays({0, 0.9f, 0}, {0, 0, 0}, 1.5f)};
        const RenderResult result = render(scene, settings(16, 4, 200'000));
        EXPECT_EQ(mean(layer(result, "direct")).g, 0);
        return mean(layer(result, "caustic")).g;
    };
    const double bare = caustic(0);
    // The path tracer's shadow rays end at glass, and its paths cannot hit the sun.
    EXPECT_EQ(bare > 0, has_map(GetParam()));
    EXPECT_RELATIVE(caustic(2), bare * 0.75 * 0.75, 0.03);
}

// A surface that lets light pass may lie in the plane of another.
TEST_P(Alpha, ShowsWhatLiesInItsPlane) {
    for (const bool first : {false, true}) {
        Scene scene;
        const auto veil = add_material(scene, with_alpha(lambertian({1, 0, 0}), 0.5f));
        const auto wall = add_material(scene, lambertian({0, 1, 0}));
        add_floor(scene, 2, 0, first ? veil : wall);
        add_floor(scene, 2, 0, first ? wall : veil);
        scene.lights = {directional_light({0, -1, 0}, glm::vec3(pi))};
        const glm::dvec3 l =
            radiance(scene, settings(4, 64, 1000), {0.1f, 3, 0.2f}, {0.1f, 0, 0}, "direct");
        EXPECT_NEAR(l.r, first ? 0.5 : 0, 1e-5);
        EXPECT_NEAR(l.g, first ? 0.5 : 1, 0.05);
    }
}

// An area light, which both paths and photons find behind a veil. Each layer is compared by itself.
TEST_P(Alpha, SlowLayersAgreeWithThePathTracer) {
    Scene scene = box_scene(lambertian({0.6f, 0.5f, 0.4f}));
    add_quad(scene, {-0.5f, 0.95f, -0.5f}, {1, 0, 0}, {0, 0, 1},
             add_material(scene, emitter(glm::vec3(2))));
    Material varnished = lambertian({0.2f, 0.6f, 0.7f});
    varnished.specular = 1;
    varnished.roughness = 0.6f;
    add_floor(scene, 0.7f, 0.2f, add_material(scene, with_alpha(varnished, 0.4f)));
    add_quad(scene, {-0.6f, -0.9f, -0.2f}, {0.8f, 0, 0}, {0, 0.8f, -0.2f},
             add_material(scene, with_alpha(mirror({0.9f, 0.8f, 0.7f}), 0.5f)));
    add_floor(scene, 0.8f, 0.7f, add_material(scene, with_alpha(glass(1.5f, false), 0.5f)));
    scene.cameras = {look_at({0.3f, -0.1f, 0.95f}, {0, -0.4f, -1}, 70)};
    // The path tracer is noisy where a path must hit the lamp.
    RenderSettings reference = settings_of("path", 16, 4096);
    reference.seed = 7;
    const RenderResult& expected = render_once("veils", scene, reference);
    const RenderResult found =
        render(scene, settings(16, has_map(GetParam()) ? 128 : 4096, 200'000));
    expect_same_layers(found, expected, 0.04);
    EXPECT_GT(mean(layer(expected, "caustic")).g, 0.2 * mean(layer(expected, "direct")).g);
}

// As a rasteriser shows a closed room from outside; its walls still keep the light in and out.
TEST_P(Alpha, CulledBackFacesAreNotSeen) {
    for (const bool two_sided : {false, true}) {
        Scene scene = room_scene();
        for (Material& material : scene.materials) {
            material.double_sided = two_sided;
        }
        scene.lights.push_back(directional_light({0, 0, -1}, glm::vec3(100)));
        RenderSettings shown = settings(16, 16, 50'000);
        const auto seen_from = [&](float z) {
            scene.cameras = {parallel_rays({0.4f, 0.2f, z}, {0.4f, 0.2f, -1}, 0.8f)};
            return mean(layer(render(scene, shown), "")).g;
        };
        const double expected = seen_from(two_sided ? 3.0f : 0.9f);
        shown.cull_back_faces = true;
        EXPECT_RELATIVE(seen_from(3), expected, 0.03) << two_sided;
    }
}

// Shadow rays do not find a lamp behind what is culled, so that paths must count all of it.
TEST_P(Alpha, LobesReflectWhatIsBehindCulledFaces) {
    Scene scene;
    Material varnish = lambertian(glm::vec3(0));
    varnish.coat = 1;
    varnish.coat_roughness = 0.3f;
    add_floor(scene, 2, 0, add_material(scene, varnish));
    Material lamp = emitter(glm::vec3(1));
    add_quad(scene, {-1, 0.5f, -1}, {2, 0, 0}, {0, 2, 0}, add_material(scene, lamp));
    scene.cameras = {look_at({0, 1, 2}, {0, 0, -0.3f}, 20)};
    const RenderSettings bare = settings(8, 1024, 0);
    const double expected = mean(layer(render(scene, bare), "")).g;
    Scene covered = scene; // by a wall that faces the lamp
    add_quad(covered, {-1, 0, -0.9f}, {0, 3, 0}, {2, 0, 0},
             add_material(covered, lambertian(glm::vec3(0))));
    RenderSettings culled = bare;
    EXPECT_LT(mean(layer(render(covered, culled), "")).g, 0.2 * expected);
    culled.cull_back_faces = true;
    EXPECT_RELATIVE(mean(layer(render(covered, culled), "")).g, expected, 0.05);
}

INSTANTIATE_ESTIMATES(Alpha);

} // namespace
} // namespace argand::testing
