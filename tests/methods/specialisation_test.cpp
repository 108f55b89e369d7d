// Only what a scene requires is compiled, run and allocated, and that changes no bit.
#include "rendering.hpp"
#include "shared/geometry_records.h"
#include "support/recording_device.hpp"
#include "support/specialised.hpp"

#include <filesystem>

namespace argand::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Not;

/// Literals by which code is known in a kernel.
const std::map<std::string, std::vector<float>> marks = {
    {"eye_vertex", {0.04f,          // transmission: bsdf.h, lobe_probabilities
                    0.64f,          // Phong: phong.h, phong_albedo
                    1e-12f,         // GGX: ggx.h, ggx_sample_normal
                    12.566371f}},   // sky: lights.h, light_sample
    {"photon_scatter", {0.04f, 0.64f, 1e-12f}},
    {"photon_emit", {39.478417f,    // sky: lights.h, light_power
                     0.001f}},      // spots: lights.h, spot_ramp
};

RenderSettings small(const std::string& method, bool everything = false) {
    RenderSettings settings = settings_of(method, 12, 2);
    settings.photons = 3000;
    settings.everything = everything;
    return settings;
}

/// Walls that only scatter diffusely, and one light.
Scene diffuse_box() { return room_scene(); }

Scene with_glass_sphere(Scene scene) {
    add_sphere(scene, {0.4f, -0.6f, 0.3f}, 0.35f, 6, false, add_material(scene, glass(1.5f, true)));
    return scene;
}

/// Something of everything.
Scene mixed_scene() {
    Scene scene = with_glass_sphere(diffuse_box());
    scene.name = "mixed";
    Material steel;
    steel.roughness = 0.5f;
    add_sphere(scene, {-0.5f, 0.5f, -0.2f}, 0.25f, 4, true, add_material(scene, steel));
    Material veil = lambertian({0.5f, 0.6f, 0.7f});
    veil.coverage = 0.5f;
    veil.phong = Phong{glm::vec3(0.3f), 40};
    add_quad(scene, {0.2f, -0.4f, -0.5f}, {0.5f, 0, 0.1f}, {0, 0.8f, 0}, add_material(scene, veil));
    add_quad(scene, {-0.3f, 0.9f, -0.3f}, {0.4f, 0, 0}, {0, 0, 0.4f}, add_material(scene, emitter(glm::vec3(3))));
    scene.lights.push_back(spot_light({0, 0.5f, 0.5f}, {0, -1, -0.2f}, glm::vec3(2), 0.2f, 0.6f));
    scene.lights.push_back(directional_light({0.1f, -0.3f, -1}, glm::vec3(0.5f)));
    scene.sky = glm::vec3(0.2f, 0.3f, 0.4f);
    scene.triangles.erase(scene.triangles.begin(), scene.triangles.begin() + 2);    // a hole, through which it is seen
    scene.triangle_material.erase(scene.triangle_material.begin(), scene.triangle_material.begin() + 2);
    return scene;
}

class Specialisation : public EveryMethod {
protected:
    void expect_same_bits(const Scene& scene, RenderSettings settings) {
        settings.everything = false;
        const RenderResult specialised = render(scene, settings);
        settings.everything = true;
        const RenderResult everything = render(scene, settings);
        EXPECT_TRUE(same_bits(specialised, everything)) << scene.name << (settings.final_gather ? ", final gather" : "");
        EXPECT_EQ(specialised.statistics.flux.absorbed, everything.statistics.flux.absorbed) << scene.name;
        EXPECT_EQ(specialised.statistics.photons_stored, everything.statistics.photons_stored) << scene.name;
    }
};

TEST_P(Specialisation, ChangesNoBit) {
    for (const char* name : {"cornell_point.glb", "veil.glb", "courtyard.glb"}) {
        expect_same_bits(load_asset(name), small(GetParam()));
    }
    expect_same_bits(mixed_scene(), small(GetParam()));
}

TEST_P(Specialisation, ChangesNoBitOfAFinalGather) {
    RenderSettings settings = small(GetParam());
    settings.final_gather = true;
    for (const char* name : {"cornell_area.glb", "sky_room.glb"}) {
        expect_same_bits(load_asset(name), settings);
    }
}

TEST_P(Specialisation, SlowChangesNoBitOfAnyScene) {
    for (const auto& entry : std::filesystem::directory_iterator(ARGAND_SOURCE_DIR "/assets")) {
        if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf") {
            RenderSettings settings = small(GetParam());
            settings.photons = 20'000;
            settings.width = settings.height = 32;
            expect_same_bits(load_asset(entry.path().filename()), settings);
        }
    }
}

TEST_P(Specialisation, DiffuseBoxHasNoCodeOfWhatItHasNot) {
    RecordingDevice everything(device());
    testing::render(everything, diffuse_box(), small(GetParam(), true));
    RecordingDevice specialised_(device());
    testing::render(specialised_, diffuse_box(), small(GetParam()));
    EXPECT_LE(specialised_.variants().size(), everything.variants().size());

    std::map<std::string, SpecialisedCode> all;
    for (const auto& [kernel, constants] : everything.variants()) {
        all[kernel->name] = specialised(*kernel, constants);
    }
    std::set<std::string> seen;
    for (const auto& [kernel, constants] : specialised_.variants()) {
        const std::string name = kernel->name;
        if (!marks.contains(name)) {
            continue;
        }
        seen.insert(name);
        const SpecialisedCode code = specialised(*kernel, constants);
        EXPECT_LT(code.instructions, all[name].instructions * 2 / 3) << name;
        EXPECT_THAT(code.buffers, AllOf(Not(Contains("normals")), Not(Contains("light_choices")))) << name;
        EXPECT_THAT(all[name].buffers, Contains(name == "photon_scatter" ? "normals" : "light_choices")) << name;
        for (const float mark : marks.at(name)) {
            EXPECT_THAT(all[name].numbers, Contains(mark)) << name;
            EXPECT_THAT(code.numbers, Not(Contains(mark))) << name;
        }
    }
    EXPECT_EQ(seen.size(), GetParam() == "path" ? 1u : marks.size());
}

/// Of the kernels that shade, and of those that ask the map.
TEST_P(Specialisation, EveryFeatureIsCode) {
    RecordingDevice everything(device());
    testing::render(everything, mixed_scene(), small(GetParam(), true));
    std::map<std::string, RecordingDevice::Variant> variants;
    for (const RecordingDevice::Variant& variant : everything.variants()) {
        variants[variant.first->name] = variant;
    }
    Plan whole = make_plan({}, {.everything = true});
    for (const Feature left_out : all_features()) {
        Plan plan = whole;
        plan.required.erase(left_out);
        if (plan.material_features() == whole.material_features() && plan.light_kinds() == whole.light_kinds()) {
            continue;
        }
        std::size_t smaller = 0;
        for (auto& [name, variant] : variants) {
            std::vector<std::uint32_t> constants = variant.second;
            for (std::size_t i = 0; i < constants.size(); ++i) {
                const std::string constant = variant.first->constants[i].name;
                constants[i] = constant == "material_features" ? plan.material_features()
                               : constant == "light_kinds"     ? plan.light_kinds()
                                                               : constants[i];
            }
            if (constants != variant.second) {
                const std::size_t before = specialised(*variant.first, variant.second).instructions;
                const std::size_t after = specialised(*variant.first, constants).instructions;
                EXPECT_LE(after, before) << name << " without " << text_of(left_out).name;
                smaller += after < before ? 1 : 0;
            }
        }
        EXPECT_GT(smaller, 0u) << text_of(left_out).name;
    }
}

TEST_P(Specialisation, PassesAndBuffersThatAreNotNeededDoNotExist) {
    const auto recorded = [&](const Scene& scene, bool everything) {
        auto recording = std::make_unique<RecordingDevice>(device());
        testing::render(*recording, scene, small(GetParam(), everything));
        return recording;
    };
    const auto with = recorded(diffuse_box(), true);
    const auto without = recorded(diffuse_box(), false);
    EXPECT_GT(with->bytes_of("normals"), 0u);
    EXPECT_EQ(without->bytes_of("normals"), 0u);
    EXPECT_EQ(without->bytes_of("light choices"), 0u);
    EXPECT_GT(without->runs_of("shadow_add"), 0u);
    const bool map = GetParam() != "path";
    EXPECT_EQ(without->bytes_of("area sums") > 0, map);
    EXPECT_EQ(without->runs_of("photon_emit") > 0, map);
    EXPECT_EQ(without->stages().contains("gather photons"), map);

    // Mirrors alone have nothing to send a shadow ray from.
    Scene mirrors = box_scene(mirror(glm::vec3(0.5f)));
    mirrors.lights.push_back(point_light({0, 0.5f, 0}, glm::vec3(1)));
    const auto dark = recorded(mirrors, false);
    EXPECT_EQ(dark->runs_of("shadow_add"), 0u);
    EXPECT_FALSE(dark->stages().contains("trace shadow rays"));
    EXPECT_EQ(dark->bytes_of("shadow rays"), sizeof(RayRecord));
    EXPECT_GT(recorded(mirrors, true)->runs_of("shadow_add"), 0u);
}

INSTANTIATE_METHODS(Specialisation);

} // namespace
} // namespace argand::testing
