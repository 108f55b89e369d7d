// Brushed metal, rendered by every method.
#include "rendering.hpp"
#include "scene/tangents.hpp"
#include "textured.hpp"

namespace argand::testing {
namespace {

class Anisotropy : public EveryMethod {};

Material brushed(float roughness, double strength, double rotation) {
    Material m;
    m.base_color = {0.9f, 0.6f, 0.3f};
    m.roughness = roughness;
    m.anisotropy =
        glm::vec2(float(strength * std::cos(rotation)), float(strength * std::sin(rotation)));
    return m;
}

/// F D V of KHR_materials_anisotropy. t, b, n: tangent, bitangent, normal.
double metal(double color, double roughness, double strength, const glm::dvec3& t,
             const glm::dvec3& b, const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& i) {
    const double ab = roughness * roughness;
    const double at = ab + (1 - ab) * strength * strength;
    const auto local = [&](const glm::dvec3& v) {
        return glm::dvec3(glm::dot(v, t), glm::dot(v, b), glm::dot(v, n));
    };
    const glm::dvec3 h = local(glm::normalize(o + i)), lo = local(o), li = local(i);
    const double w = glm::dot(h, h / glm::dvec3(at * at, ab * ab, 1));
    const double masked_o = glm::length(lo * glm::dvec3(at, ab, 1));
    const double masked_i = glm::length(li * glm::dvec3(at, ab, 1));
    const double fresnel = color + (1 - color) * std::pow(1 - glm::dot(lo, h), 5);
    return fresnel / (double(pi) * at * ab * w * w) * 0.5 / (li.z * masked_o + lo.z * masked_i);
}

/// A floor of brushed metal with u along x and v along z, so that the bitangent is along -z.
Scene brushed_floor(const Material& m) {
    Scene scene = floor_scene(m);
    scene.uv_sets = 1;
    project(scene, 2);
    return scene;
}

// From both sides of the floor, the direction turned by the factor or by a texel.
TEST_P(Anisotropy, ReflectsASunAsTheExtensionSays) {
    for (const double rotation : {0.0, 0.6, 2.2}) {
        for (const bool by_texel : {false, true}) {
            const double strength = 0.6;
            Scene scene = brushed_floor(
                brushed(0.3f, by_texel ? 1 : strength, by_texel ? rotation - 0.5 : rotation));
            if (by_texel) {
                add_texture(scene, 0, material_other_textures, 1,
                            {texel(int(std::lround(127.5 + 127.5 * std::cos(0.5))),
                                   int(std::lround(127.5 + 127.5 * std::sin(0.5))), 153)},
                            true);
                scene.textures.back().use = TextureUse::anisotropy;
            }
            scene.materials[0].double_sided = true;
            add_tangents(scene);
            for (const double side : {1.0, -1.0}) {
                const glm::dvec3 i = glm::normalize(glm::dvec3(0.3, side, -0.4));
                const glm::dvec3 o = glm::normalize(glm::dvec3(0.2, side, 0.6));
                scene.lights = {directional_light(-glm::vec3(i), glm::vec3(2))};
                RenderSettings settings = settings_of(GetParam(), 4, 4);
                settings.photons = 1000;
                settings.follow_roughness = 0;
                const double found =
                    radiance(scene, settings, glm::vec3(1, 0, 1) + 3.0f * glm::vec3(o), {1, 0, 1},
                             "direct")
                        .r;
                const glm::dvec3 x(1, 0, 0), y(0, 0, -1);
                const glm::dvec3 t = std::cos(rotation) * x + std::sin(rotation) * y;
                const glm::dvec3 b = -std::sin(rotation) * x + std::cos(rotation) * y;
                const double once = 2 * std::abs(i.y) *
                                    metal(0.9, 0.3, strength, t, b, glm::dvec3(0, side, 0), o, i);
                // Facets also reflect more than once: here up to 0.06.
                EXPECT_GT(found, 0.99 * once) << rotation << ", " << by_texel << ", " << side;
                EXPECT_LT(found, 1.01 * once + 0.06)
                    << rotation << ", " << by_texel << ", " << side;
            }
        }
    }
}

TEST_P(Anisotropy, SlowLayersAgreeWithThePathTracer) {
    Scene scene = box_scene(lambertian({0.6f, 0.5f, 0.4f}));
    add_quad(scene, {-0.5f, 0.95f, -0.5f}, {1, 0, 0}, {0, 0, 1},
             add_material(scene, emitter(glm::vec3(2))));
    add_floor(scene, 0.9f, -0.8f, add_material(scene, brushed(0.4f, 0.8, 0.4)));
    add_sphere(scene, {0.45f, -0.4f, -0.3f}, 0.3f, 8, true,
               add_material(scene, brushed(0.1f, 0.6, 1.3)));
    Material dielectric = brushed(0.5f, 0.9, 0);
    dielectric.metallic = 0;
    add_quad(scene, {-0.9f, -0.7f, -0.6f}, {0, 1, 0}, {1, 0, -0.3f},
             add_material(scene, dielectric));
    project_obliquely(scene);
    scene.uv_sets = 1;
    add_tangents(scene);
    scene.cameras = {look_at({0.3f, -0.1f, 0.95f}, {0, -0.4f, -1}, 70)};
    RenderSettings reference = settings_of("path", 16, 4096);
    reference.seed = 7;
    const RenderResult& expected = render_once("brushed", scene, reference);
    RenderSettings settings = settings_of(GetParam(), 16, has_map(GetParam()) ? 128 : 4096);
    settings.photons = 200'000;
    expect_same_layers(render(scene, settings), expected, 0.05, 0.15);
}

INSTANTIATE_ESTIMATES(Anisotropy);

} // namespace
} // namespace argand::testing
