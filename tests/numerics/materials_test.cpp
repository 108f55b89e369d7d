// Extreme indices of refraction, roughnesses and albedos.
#include "extremes.hpp"

#include "support/scratch_directory.hpp"

#include <fstream>

namespace argand::testing {
namespace {

/// Light that enters this block leaves it through the parallel face. Facets would trap light in
/// glass of a high index for long.
Scene block_in_a_furnace(const Material& material) {
    Scene scene;
    scene.name = "block in a furnace";
    add_box(scene, {-1, -0.7f, -0.4f}, {1, 0.7f, 0.4f}, add_material(scene, material), false);
    scene.sky = glm::vec3(1);
    scene.cameras = {look_at({2, 1.5f, 3}, {0, 0, 0}, 35)};
    return scene;
}

Scene sphere_in_a_furnace(const Material& material) {
    Scene scene;
    scene.name = "sphere in a furnace";
    add_sphere(scene, glm::vec3(0), 1, 8, false, add_material(scene, material));
    scene.sky = glm::vec3(1);
    scene.cameras = {look_at({0, 0, 4}, {0, 0, 0}, 35)};
    return scene;
}

TEST_F(Extremes, GlassOfAnyIndexLosesNothing) {
    Largest worst;
    for (const float ior : {0.0f, 1.0f, 1 + 0x1p-23f, 1.5f, 10.0f}) {
        for (const bool solid : {true, false}) {
            const Scene scene = block_in_a_furnace(glass(ior, solid));
            for (const std::string method : {"path", "footprints"}) {
                const double found = mean(layer(sound(scene, small(method, 64, 8)), "")).g;
                EXPECT_NEAR(found, 1, 0.05)
                    << "ior " << ior << ", solid " << solid << ", " << method;
                worst.take(std::abs(found - 1),
                           fmt::format("{} {} {:.8g}", method, solid ? "solid" : "thin", ior));
            }
        }
    }
    record_extreme("index of refraction 0, 1, 1 + 10^-7, 1.5, 10, solid and thin",
                   "path, footprints: a block of it under a white sky is white; mean within 5 %",
                   worst.text());
}

/// A file with a cube of glass of this index.
Scene load_cube_of_glass(const char* ior, bool solid) {
    const ScratchDirectory directory;
    nlohmann::json file =
        nlohmann::json::parse(read_text(ARGAND_SOURCE_DIR "/assets/closed_box.gltf"));
    for (nlohmann::json& material : file.at("materials")) {
        material = nlohmann::json::parse(fmt::format(
            R"({{"pbrMetallicRoughness": {{"metallicFactor": 0, "roughnessFactor": 0}}, "extensions": {{
                "KHR_materials_transmission": {{"transmissionFactor": 1}},
                "KHR_materials_volume": {{"thicknessFactor": {}}},
                "KHR_materials_ior": {{"ior": {}}}}}}})",
            solid ? 1 : 0, ior));
    }
    std::ofstream(directory / "cube.gltf") << file;
    Scene scene = load_gltf(directory / "cube.gltf");
    scene.sky = glm::vec3(1);
    scene.cameras = {look_at({4, 3, 6}, {0, 0, 0}, 35)};
    return scene;
}

TEST_F(Extremes, GlassOfAnyIndexFromAFile) {
    const std::pair<const char*, float> indices[] = {
        {"0", 0.0f}, {"1", 1.0f}, {"1.0000001", 1 + 0x1p-23f}, {"10", 10.0f}};
    Largest worst;
    for (const auto& [written, read] : indices) {
        for (const bool solid : {true, false}) {
            const Scene scene = load_cube_of_glass(written, solid);
            EXPECT_EQ(scene.materials.at(scene.triangle_material.at(0)).ior, read);
            for (const std::string& method : exact_methods()) {
                const RenderResult result = sound(scene, small(method, 16, 8));
                if (method == "path" || method == "footprints") {
                    const double found = mean(layer(result, "")).g;
                    EXPECT_NEAR(found, 1, 0.05) << written << ", solid " << solid << ", " << method;
                    worst.take(std::abs(found - 1),
                               fmt::format("{} {} {}", method, solid ? "solid" : "thin", written));
                }
            }
        }
    }
    record_extreme("files with an index of refraction of 0, 1, 1 + 10^-7 and 10",
                   "read to the bit, pictures finite; path, footprints: a cube of it under a white "
                   "sky is white, mean "
                   "within 5 %",
                   worst.text());
}

TEST_F(Extremes, GlassOfIndexOneIsInvisible) {
    Scene with = room_scene();
    add_sphere(with, {0.4f, 0, 0.2f}, 0.3f, 8, false, add_material(with, glass(1, true)));
    RenderSettings settings = small("path", 32);
    const double error =
        mean(layer(sound(with, settings), "")).g / mean(layer(sound(room_scene(), settings), "")).g;
    // Shadow rays stop at glass, so only photons carry light from a delta light through it.
    settings.method = "photons";
    const double all =
        mean(layer(sound(with, settings), "")).g / mean(layer(sound(room_scene(), settings), "")).g;
    EXPECT_LT(error, 1);
    EXPECT_NEAR(all, 1, 0.05);
    record_extreme("a sphere of index 1 in a room",
                   "photons: as if it were not there; mean within 5 %", shown(std::abs(all - 1)));
}

TEST_F(Extremes, MetalFromMirrorToRough) {
    std::string figures;
    for (const float roughness : {0.0f, 1e-4f, 0.0317f, 1.0f}) {
        Material metal = mirror();
        metal.roughness = roughness;
        Largest spread;
        double lowest = 1;
        for (const std::string& method : exact_methods()) {
            const double found =
                mean(layer(sound(sphere_in_a_furnace(metal), small(method, 16)), "")).g;
            // Smooth metal loses nothing; rough metal loses up to a third, which a second
            // scattering would return.
            EXPECT_LT(found, 1.01) << "roughness " << roughness << ", " << method;
            EXPECT_GT(found, roughness < 0.5f ? 0.99 : 0.6)
                << "roughness " << roughness << ", " << method;
            lowest = std::min(lowest, found);
        }
        figures += fmt::format("{}{:.2g}: {:.4f}", figures.empty() ? "" : "; ", roughness, lowest);
    }
    record_extreme("roughness 0, 10^-4, 0.0317 (the least that is not a mirror), 1",
                   "a white metal under a white sky: at least 0.99, rough 0.6, at most 1.01",
                   figures);
}

TEST_F(Extremes, AThousandBouncesBetweenBlackWalls) {
    for (const std::string& method : exact_methods()) {
        RenderSettings settings = small(method);
        settings.bounces = 1000;
        EXPECT_EQ(mean(layer(sound(box_scene(emitter(glm::vec3(1))), settings), "")), glm::dvec3(1))
            << method;
    }
    record_extreme("albedo 0, 1,000 bounces", "the emitted radiance, to the bit", "to the bit");
}

} // namespace
} // namespace argand::testing
