// Argand compiles, runs and allocates only what a scene requires, which changes no bit of an image.
#include "methods/plan_render.hpp"
#include "rendering.hpp"
#include "scene/studio.hpp"
#include "shared/bsdf.h"
#include "shared/geometry_records.h"
#include "shared/query_record.h"
#include "support/recording_device.hpp"
#include "support/specialised.hpp"

#include <filesystem>
#include <map>
#include <set>

namespace argand::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Not;

/// Literals that reveal a piece of code in a kernel.
const std::map<std::string, std::vector<float>> marks = {
    {"eye_vertex",
     {0.04f,        // transmission: bsdf.h, lobe_probabilities
      0.64f,        // Phong: phong.h, phong_albedo
      12.566371f}}, // sky: lights.h, light_sample
    {"photon_scatter", {0.04f, 0.64f}},
    {"connect_photons", {0.04f, 0.64f}},
    {"photon_emit",
     {39.478417f, // sky: lights.h, light_power
      0.001f}},   // spots: lights.h, spot_ramp
};

RenderSettings small(const std::string& method, bool everything = false) {
    RenderSettings settings = settings_of(method, 12, 2);
    settings.photons = 3000;
    settings.everything = everything;
    return settings;
}

/// Diffuse walls and one light.
Scene diffuse_box() { return room_scene(); }

Scene with_glass_sphere(Scene scene) {
    add_sphere(scene, {0.4f, -0.6f, 0.3f}, 0.35f, 6, false, add_material(scene, glass(1.5f, true)));
    return scene;
}

/// A scene that requires every feature.
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
    add_quad(scene, {-0.3f, 0.9f, -0.3f}, {0.4f, 0, 0}, {0, 0, 0.4f},
             add_material(scene, emitter(glm::vec3(3))));
    Material amber = glass(1.3f, true);
    amber.absorption = {1, 2, 4};
    add_sphere(scene, {0.5f, -0.6f, 0.3f}, 0.2f, 4, true, add_material(scene, amber));
    Material frost = glass(1.4f, true);
    frost.roughness = 0.5f;
    add_sphere(scene, {-0.6f, -0.6f, 0.4f}, 0.15f, 4, true, add_material(scene, frost));
    Material paint = lambertian({0.3f, 0.5f, 0.2f});
    paint.coat = 0.8f;
    paint.coat_roughness = 0.4f;
    paint.film = 0.5f;
    paint.sheen_color = {0.5f, 0.4f, 0.3f};
    paint.sheen_roughness = 0.5f;
    paint.specular = 1;
    add_sphere(scene, {0.1f, 0.1f, 0.5f}, 0.15f, 4, true, add_material(scene, paint));
    Material prism = glass(1.6f, true);
    prism.dispersion = 2;
    prism.coat = 1;
    add_sphere(scene, {-0.3f, 0.1f, 0.5f}, 0.15f, 4, true, add_material(scene, prism));
    Material label = lambertian({0.7f, 0.8f, 0.9f});
    label.unlit = true;
    add_quad(scene, {-0.9f, -0.5f, -0.9f}, {0.3f, 0, 0}, {0, 0.3f, 0}, add_material(scene, label));
    scene.lights.push_back(spot_light({0, 0.5f, 0.5f}, {0, -1, -0.2f}, glm::vec3(2), 0.2f, 0.6f));
    scene.lights.push_back(directional_light({0.1f, -0.3f, -1}, glm::vec3(0.5f)));
    scene.sky = glm::vec3(0.2f, 0.3f, 0.4f);
    scene.triangles.erase(scene.triangles.begin(),
                          scene.triangles.begin() + 2); // a hole, through which it is seen
    scene.triangle_material.erase(scene.triangle_material.begin(),
                                  scene.triangle_material.begin() + 2);
    return scene;
}

/// Indexed by kernel name.
using Variants = std::map<std::string, RecordingDevice::Variant>;

class Specialisation : public EveryMethod {
protected:
    void expect_same_bits(const Scene& scene, RenderSettings settings) {
        settings.everything = false;
        const RenderResult specialised = render(scene, settings);
        settings.everything = true;
        const RenderResult everything = render(scene, settings);
        EXPECT_TRUE(same_bits(specialised, everything))
            << scene.name << (settings.final_gather ? ", final gather" : "");
        EXPECT_EQ(specialised.statistics.flux.absorbed, everything.statistics.flux.absorbed)
            << scene.name;
        EXPECT_EQ(specialised.statistics.photons_stored, everything.statistics.photons_stored)
            << scene.name;
    }

    /// How many kernels of `marks` the method runs.
    static std::size_t kernels_with_marks() {
        return has_eye_paths_only(GetParam()) ? 1
               : has_light_paths(GetParam())  ? marks.size()
                                              : marks.size() - 1;
    }

    std::unique_ptr<RecordingDevice> recorded(const Scene& scene, bool everything) {
        auto recording = std::make_unique<RecordingDevice>(device());
        testing::render(*recording, scene, small(GetParam(), everything));
        return recording;
    }

    /// One variant of each kernel that a render dispatches, by name.
    Variants variants(const Scene& scene, bool everything) {
        return by_name(*recorded(scene, everything));
    }

    static Variants by_name(const RecordingDevice& recording) {
        Variants found;
        for (const RecordingDevice::Variant& variant : recording.variants()) {
            found[variant.first->name] = variant;
        }
        return found;
    }
};

/// Each variant is optimised once in the process: it takes long, and methods share kernels.
const SpecialisedCode& code_of(const RecordingDevice::Variant& variant) {
    static std::map<RecordingDevice::Variant, SpecialisedCode> kept;
    const auto found = kept.find(variant);
    return found != kept.end()
               ? found->second
               : kept.emplace(variant, specialised(*variant.first, variant.second)).first->second;
}

/// The variant with one constant changed.
RecordingDevice::Variant with_constant(RecordingDevice::Variant variant, const std::string& name,
                                       std::uint32_t value) {
    for (std::size_t i = 0; i < variant.second.size(); ++i) {
        if (variant.first->constants[i].name == name) {
            variant.second[i] = value;
        }
    }
    return variant;
}

TEST_P(Specialisation, SlowChangesNoBit) {
    expect_same_bits(diffuse_box(), small(GetParam()));
    expect_same_bits(mixed_scene(), small(GetParam()));
    Scene under_a_picture = mixed_scene();
    under_a_picture.sky.reset();
    under_a_picture.environment = studio();
    expect_same_bits(under_a_picture, small(GetParam()));
}

class SpecialisationOfScenes : public Specialisation {};

TEST_P(SpecialisationOfScenes, SlowChangesNoBit) {
    RenderSettings settings = small(GetParam());
    settings.photons = 20'000;
    settings.width = settings.height = 32;
    std::set<std::set<Feature>> seen; // scenes that require the same run the same kernels
    for (const auto& entry : std::filesystem::directory_iterator(ARGAND_SOURCE_DIR "/assets")) {
        if (entry.path().extension() != ".glb" && entry.path().extension() != ".gltf") {
            continue;
        }
        const Scene scene = load_asset(entry.path().filename());
        std::set<Feature> features;
        for (const auto& [feature, reason] : plan_render(scene, settings).required) {
            features.insert(feature);
        }
        if (!seen.insert(features).second) {
            continue;
        }
        settings.final_gather = false;
        expect_same_bits(scene, settings);
        if (has_map(GetParam())) {
            settings.final_gather = true;
            expect_same_bits(scene, settings);
        }
    }
    EXPECT_GT(seen.size(), 8u);
}

// Kernels have modules without textures, and without materials that few scenes have
// (docs/device.md).
TEST_P(Specialisation, RunsTheLeanestModuleThatKnowsTheScene) {
    // How many kernels run a module with these bits of materials.
    const auto modules = [this](const Scene& scene) {
        std::map<std::uint32_t, int> count;
        const auto recording = recorded(scene, false);
        for (const auto& [kernel, constants] : recording->variants()) {
            std::size_t last = 0;
            std::uint32_t bits = kernel->lean.empty() ? 0 : std::uint32_t{MATERIAL_ALL};
            const auto used = module_for(*kernel, constants);
            for (const LeanModule& lean : kernel->lean) {
                EXPECT_LT(last, lean.spirv.size()) << kernel->name;
                last = lean.spirv.size();
                if (lean.spirv.data() == used.data()) {
                    bits = lean.limits.front().bits;
                }
            }
            EXPECT_LT(last, kernel->spirv.size()) << kernel->name;
            ++count[bits];
        }
        return count;
    };
    auto plain = modules(with_glass_sphere(diffuse_box()));
    EXPECT_GE(plain[MATERIAL_PLAIN], has_map(GetParam()) ? 2 : 1);
    EXPECT_EQ(plain[MATERIAL_ALL], 0);

    Scene perforated = diffuse_box();
    perforated.materials[0].coverage = 0.5f;
    auto lean = modules(perforated);
    EXPECT_EQ(lean[MATERIAL_PLAIN], 0);
    EXPECT_GE(lean[MATERIAL_LEAN], has_map(GetParam()) ? 3 : 1);

    auto whole = modules(mixed_scene());
    EXPECT_EQ(whole[MATERIAL_LEAN] + whole[MATERIAL_PLAIN], 0);
    EXPECT_GE(whole[MATERIAL_ALL], lean[MATERIAL_LEAN]);
}

TEST_P(Specialisation, DiffuseBoxHasNoCodeOfWhatItHasNot) {
    const Variants everything = variants(diffuse_box(), true);
    const Variants needed = variants(diffuse_box(), false);
    std::size_t seen = 0;
    for (const auto& [kernel, kernel_marks] : marks) {
        const auto found = needed.find(kernel);
        if (found == needed.end()) {
            continue;
        }
        ++seen;
        const SpecialisedCode& code = code_of(found->second);
        const SpecialisedCode& all = code_of(everything.at(kernel));
        EXPECT_LT(code.instructions, all.instructions * 2 / 3) << kernel;
        EXPECT_THAT(code.buffers, AllOf(Not(Contains("normals")), Not(Contains("light_choices"))))
            << kernel;
        EXPECT_THAT(all.buffers, Contains(kernel == "photon_scatter" ? "normals" : "light_choices"))
            << kernel;
        for (const float mark : kernel_marks) {
            EXPECT_THAT(all.numbers, Contains(mark)) << kernel;
            EXPECT_THAT(code.numbers, Not(Contains(mark))) << kernel;
        }
    }
    EXPECT_EQ(seen, kernels_with_marks());
}

class SpecialisationToGlass : public Specialisation {};

TEST_P(SpecialisationToGlass, GlassSphereAddsTransmissionAndNothingElse) {
    const auto with = recorded(with_glass_sphere(diffuse_box()), false);
    const auto without = recorded(diffuse_box(), false);
    const Variants glass = by_name(*with), diffuse = by_name(*without);
    constexpr float transmission = 0.04f;
    std::size_t seen = 0;
    for (const auto& [kernel, kernel_marks] : marks) {
        const auto found = glass.find(kernel);
        if (found == glass.end()) {
            continue;
        }
        ++seen;
        const SpecialisedCode& code = code_of(found->second);
        const SpecialisedCode& bare = code_of(diffuse.at(kernel));
        for (const float mark : kernel_marks) {
            if (mark == transmission) {
                EXPECT_THAT(code.numbers, Contains(mark)) << kernel;
            } else {
                EXPECT_THAT(code.numbers, Not(Contains(mark))) << kernel;
            }
        }
        EXPECT_EQ(code.buffers, bare.buffers) << kernel;
        if (kernel == "photon_emit") {
            EXPECT_EQ(code.instructions, bare.instructions) << "light is emitted as before";
            continue;
        }
        // The added materials include refraction, but no rough reflection.
        EXPECT_GT(code.instructions, bare.instructions + 100) << kernel;
        Plan plan = make_plan(with_glass_sphere(diffuse_box()), {});
        ASSERT_TRUE(plan.required.contains(Feature::refraction));
        plan.required.erase(Feature::refraction);
        EXPECT_LT(
            code_of(with_constant(found->second, "material_features", plan.material_features()))
                .instructions,
            code.instructions)
            << kernel;
    }
    EXPECT_EQ(seen, kernels_with_marks());
    // The same passes, without the buffers that the scene does not need.
    EXPECT_EQ(with->stages(), without->stages());
    for (const char* name : {"normals", "light choices"}) {
        EXPECT_EQ(with->bytes_of(name), 0u) << name;
    }
}

// GGX has no literal of its own: the size of the kernel reveals it.
TEST_P(Specialisation, RoughMetalAddsCode) {
    Scene metal = diffuse_box();
    metal.materials.front().metallic = 1;
    metal.materials.front().roughness = 0.5f;
    const Variants with = variants(metal, false), without = variants(diffuse_box(), false);
    EXPECT_GT(code_of(with.at("eye_vertex")).instructions,
              code_of(without.at("eye_vertex")).instructions + 200);
}

TEST_P(Specialisation, TakesNoMorePipelines) {
    for (const bool mixed : {false, true}) {
        const Scene scene = mixed ? mixed_scene() : diffuse_box();
        EXPECT_LE(recorded(scene, false)->variants().size(),
                  recorded(scene, true)->variants().size());
    }
}

TEST_P(Specialisation, PassesAndBuffersThatAreNotNeededDoNotExist) {
    const auto with = recorded(diffuse_box(), true);
    const auto without = recorded(diffuse_box(), false);
    EXPECT_GT(with->bytes_of("normals"), 0u);
    EXPECT_EQ(without->bytes_of("normals"), 0u);
    EXPECT_EQ(without->bytes_of("light choices"), 0u);
    EXPECT_GT(without->runs_of("shadow_add"), 0u);
    const bool map = has_map(GetParam());
    const bool photons = map || has_light_paths(GetParam());
    EXPECT_EQ(without->bytes_of("area sums") > 0, map);
    EXPECT_EQ(without->runs_of("photon_emit") > 0, photons);
    EXPECT_EQ(without->stages().contains("gather photons"), map);
    EXPECT_EQ(without->bytes_of("query BSDFs"), sizeof(QueryBsdfRecord));
    EXPECT_EQ(with->bytes_of("query BSDFs") > sizeof(QueryBsdfRecord), photons);

    // A scene of mirrors has no surface that casts shadow rays.
    Scene mirrors = box_scene(mirror(glm::vec3(0.5f)));
    mirrors.lights.push_back(point_light({0, 0.5f, 0}, glm::vec3(1)));
    const auto dark = recorded(mirrors, false);
    EXPECT_EQ(dark->runs_of("shadow_add"), 0u);
    EXPECT_FALSE(dark->stages().contains("trace shadow rays"));
    EXPECT_EQ(dark->bytes_of("shadow rays"), sizeof(RayRecord));
    EXPECT_GT(recorded(mirrors, true)->runs_of("shadow_add"), 0u);
}

INSTANTIATE_QUICK_AND_SLOW(Specialisation, "path", method_names());
// Glass has `bidirectional` look for points in view, near which it aims at casters of caustics.
INSTANTIATE_QUICK_AND_SLOW(SpecialisationToGlass, "path", without(method_names(), "bidirectional"));

// Kernels are compiled anew for each scene, which takes long. Other methods have these kernels,
// too.
INSTANTIATE_TEST_SUITE_P(Methods, SpecialisationOfScenes, ::testing::Values("path", "footprints"),
                         [](const auto& method) { return test_name(method.param); });

// Leaving out any one feature makes some kernel smaller and none larger.
TEST_F(RenderTest, SlowEveryMaterialAndLightIsCodeOfItsOwn) {
    if (device().info().backend == "cpu") {
        GTEST_SKIP() << "the SPIR-V does not depend on the backend";
    }
    RecordingDevice recording(device());
    testing::render(recording, diffuse_box(), small("footprints", true));
    const Plan whole = make_plan({}, {.everything = true});
    std::map<Feature, int> smaller;
    for (const RecordingDevice::Variant& variant : recording.variants()) {
        if (variant.first->name != std::string("photon_scatter") &&
            variant.first->name != std::string("photon_emit")) {
            continue;
        }
        const std::size_t all = code_of(variant).instructions;
        for (const Feature feature : all_features()) {
            Plan plan = whole;
            plan.required.erase(feature);
            const RecordingDevice::Variant without =
                with_constant(with_constant(variant, "material_features", plan.material_features()),
                              "light_kinds", plan.light_kinds());
            if (without.second != variant.second) {
                const std::size_t left = code_of(without).instructions;
                EXPECT_LE(left, all) << variant.first->name << " without " << text_of(feature).name;
                smaller[feature] += left < all ? 1 : 0;
            }
        }
    }
    // Sixteen features of materials and six of lights. Leaving out transmission alone changes no
    // constant, because refraction has its bit, too, nor does leaving out coats, because rough ones
    // have theirs.
    EXPECT_EQ(smaller.size(), 22u);
    for (const auto& [feature, kernels] : smaller) {
        EXPECT_GT(kernels, 0) << text_of(feature).name;
    }
}

} // namespace
} // namespace argand::testing
