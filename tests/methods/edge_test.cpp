// Settings at the ends of their ranges.
#include "rendering.hpp"

#include "base/error.hpp"
#include "shared/maths.h"

#include <chrono>

namespace argand::testing {
namespace {

class Edge : public EveryMethod {
protected:
    RenderSettings settings(int size = 16, std::uint32_t samples = 4) const {
        RenderSettings settings = settings_of(GetParam(), size, samples);
        settings.photons = 10'000;
        return settings;
    }

    void expect_finite_layers(const std::vector<std::string>& scenes);
};

void expect_sum_of_layers(const RenderResult& result) {
    ASSERT_EQ(result.layers.size(), 4u);
    const Image& whole = layer(result, "");
    for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
        glm::vec3 sum(0);
        for (const char* name : {"direct", "indirect", "caustic"}) {
            ASSERT_EQ(layer(result, name).pixels.size(), whole.pixels.size());
            const glm::vec3 part = layer(result, name).pixels[i];
            EXPECT_TRUE(part.r >= 0 && part.g >= 0 && part.b >= 0);
            sum += part;
        }
        EXPECT_EQ(sum, whole.pixels[i]);
    }
}

void Edge::expect_finite_layers(const std::vector<std::string>& scenes) {
    for (const std::string& name : scenes) {
        const RenderResult result = render(load_asset(name), settings());
        expect_sum_of_layers(result);
        EXPECT_GT(mean(layer(result, "")).g, 0) << name;
    }
}

TEST_P(Edge, LayersSumUpToTheWholeAndAllAreFinite) {
    expect_finite_layers({"cornell_glass.glb", "sky_room.glb"});
}

TEST_P(Edge, SlowLayersOfOtherScenesSumUpToTheWholeAndAllAreFinite) {
    expect_finite_layers({"cornell_mirror.glb", "glossy.glb", "courtyard.glb", "ring.glb",
                          "smooth_sphere.glb", "inside_glass.glb", "spot.glb", "veil.glb"});
}

TEST_P(Edge, OddSizes) {
    const Scene scene = room_scene();
    for (const auto& [width, height] :
         {std::pair(1, 1), std::pair(1, 7), std::pair(65, 1), std::pair(17, 31)}) {
        RenderSettings odd = settings();
        odd.width = width;
        odd.height = height;
        const RenderResult result = render(scene, odd);
        expect_sum_of_layers(result);
        EXPECT_EQ(layer(result, "").width, width);
        EXPECT_EQ(layer(result, "").height, height);
        EXPECT_GT(mean(layer(result, "")).g, 0);
    }
}

TEST_P(Edge, PicturesOfMoreThanOneBatch) {
    // 240 × 240 × 3 paths take more than one batch, and so do 200,000 samples of one pixel.
    RenderSettings large = settings(240, 3);
    large.bounces = 0;
    const Scene scene = room_scene();
    const Image image = layer(render(scene, large), "");
    RenderSettings small = settings(24, 64);
    small.bounces = 0;
    const Image reduced = layer(render(scene, small), "");
    for (int y = 0; y < 24; y += 6) {
        for (int x = 0; x < 24; x += 6) {
            EXPECT_NEAR(mean(image, 10 * x, 10 * y, 10 * x + 60, 10 * y + 60).g,
                        mean(reduced, x, y, x + 6, y + 6).g, 0.02 * mean(reduced).g);
        }
    }
    RenderSettings many = settings(1, 200'000);
    many.bounces = 0;
    const RenderResult pixel = render(scene, many);
    EXPECT_EQ(pixel.statistics.samples, 200'000u);
    EXPECT_RELATIVE(mean(layer(pixel, "")).g, mean(reduced).g, 0.02);
}

TEST_P(Edge, NoBouncesMeansDirectLightOnly) {
    for (const char* name : {"cornell_glass.glb", "cornell_mirror.glb"}) {
        RenderSettings direct = settings();
        direct.bounces = 0;
        const RenderResult result = render(load_asset(name), direct);
        EXPECT_GT(mean(layer(result, "direct")).g, 0);
        EXPECT_EQ(mean(layer(result, "indirect")), glm::dvec3(0));
        EXPECT_EQ(mean(layer(result, "caustic")), glm::dvec3(0));
        EXPECT_EQ(result.statistics.photons_emitted, 0u);
    }
}

TEST_P(Edge, DirectLightDoesNotDependOnTheBounces) {
    const Scene scene = room_scene();
    RenderSettings direct = settings(16, 256);
    const glm::dvec3 all = mean(layer(render(scene, direct), "direct"));
    direct.bounces = 0;
    EXPECT_RELATIVE(mean(layer(render(scene, direct), "direct")).g, all.g, 0.01);
}

TEST_P(Edge, NoLightIsABlackPicture) {
    Scene scene = room_scene();
    scene.lights.clear();
    const RenderResult result = render(scene, settings());
    EXPECT_EQ(mean(layer(result, "")), glm::dvec3(0));
    EXPECT_EQ(result.statistics.photons_stored, 0u);
    scene.lights = {point_light({0.2f, 0.8f, 0.1f}, glm::vec3(0))};
    EXPECT_EQ(mean(layer(render(scene, settings()), "")), glm::dvec3(0));
    scene.sky = glm::vec3(0);
    EXPECT_EQ(mean(layer(render(scene, settings()), "")), glm::dvec3(0));
}

TEST_P(Edge, EmptySkyIsSeenWhereNothingIs) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 1);
    scene.sky = glm::vec3(1, 2, 3);
    scene.cameras = {look_at({0, 2, 0}, {0, 4, 0})};
    EXPECT_EQ(mean(layer(render(scene, settings()), "direct")), glm::dvec3(1, 2, 3));
}

TEST_P(Edge, ScaleOfTheSceneDoesNotMatter) {
    for (const char* name : {"cornell_glass.glb", "courtyard.glb"}) {
        const Scene scene = load_asset(name);
        // Powers of two cause no rounding: only the offsets of rays differ.
        const glm::dvec3 expected = mean(layer(render(scene, settings(32, 16)), ""));
        for (const float factor : {1.0f / 1024, 1024.0f, 1e-3f, 1e3f}) {
            const glm::dvec3 actual =
                mean(layer(render(scaled(scene, factor), settings(32, 16)), ""));
            EXPECT_RELATIVE(actual.g, expected.g, 0.03) << name << ", " << factor;
        }
    }
}

TEST_P(Edge, CoincidentTrianglesWithoutEnd) {
    // More nodes than a ray may visit in one dispatch, but for maps, which take 100,000 rays.
    const int copies = GetParam() == "image-space" ? 2'500 : 50'000;
    Scene scene;
    const std::uint32_t material = add_material(scene, lambertian(glm::vec3(0.5f)));
    for (int i = 0; i < copies; ++i) {
        add_floor(scene, 10, 0, material);
    }
    scene.lights = {point_light({0, 1, 0}, glm::vec3(2))};
    RenderSettings few = settings(2, 1);
    few.photons = 200;
    few.radius = 0.1;
    EXPECT_RELATIVE(radiance(scene, few, {0.3f, 4, 0.1f}, {0, 0, 0}).g, 0.5 / pi * 2, 1e-3);
}

// Moving objects may shrink to nothing.
TEST_P(Edge, TrianglesWithoutAreaAreNotSeen) {
    const Scene scene = room_scene();
    Scene with = scene;
    const auto first = static_cast<std::uint32_t>(with.positions.size());
    const glm::vec3 point = scene.positions[0], line = scene.positions[scene.triangles[0].y];
    with.positions.insert(with.positions.end(), {point, point, line});
    with.normals.insert(with.normals.end(), 3, glm::vec3(0));
    for (std::uint32_t i = 0; i < 3000; ++i) {
        with.triangles.emplace_back(first, first + 1, i % 2 == 0 ? first : first + 2);
        with.triangle_material.push_back(
            i % static_cast<std::uint32_t>(scene.materials.size())); // the lamp's as well
    }
    const RenderResult result = render(with, settings());
    expect_sum_of_layers(result);
    const Image &image = layer(result, ""), expected = layer(render(scene, settings()), "");
    EXPECT_LT(rel_mse(image, expected, expected), 1e-4);
}

TEST_P(Edge, InterruptKeepsWhatIsFinished) {
    const Scene scene = box_scene(emitter(glm::vec3(1)));
    RenderSettings long_one = settings(64, 4096);
    int calls = 0;
    const RenderResult result = argand::render(device(), scene, long_one, [&](double done) {
        EXPECT_GT(done, 0);
        EXPECT_LT(done, 1);
        return ++calls < 2;
    });
    EXPECT_EQ(calls, 2);
    EXPECT_TRUE(result.statistics.interrupted);
    EXPECT_GT(result.statistics.samples, 0u);
    EXPECT_LT(result.statistics.samples, 4096u);
    // Every sample sees a wall that emits 1, so an image that counts its samples wrongly is not 1.
    for (const glm::vec3& pixel : layer(result, "").pixels) {
        EXPECT_EQ(pixel, glm::vec3(1));
    }
}

TEST_P(Edge, BudgetIsFilledWithPasses) {
    const Scene scene = box_scene(emitter(glm::vec3(1)));
    RenderSettings budgeted = settings(16, 2);
    budgeted.photons = 2000;
    budgeted.bounces = 2;
    render(scene, budgeted); // so that kernels are compiled
    budgeted.budget = 2;
    const auto start = std::chrono::steady_clock::now();
    const RenderResult result = render(scene, budgeted);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_GT(result.statistics.passes, 1u);
    EXPECT_EQ(result.statistics.samples, 2 * result.statistics.passes);
    EXPECT_FALSE(result.statistics.interrupted);
    // The length of passes varies when other programs use the machine.
    EXPECT_LT(seconds, 4);
    for (const glm::vec3& pixel : layer(result, "").pixels) {
        ASSERT_NEAR(pixel.g, 1, 1e-6);
    }
    // Less time than a pass takes still gives one pass.
    budgeted.budget = 1e-6;
    EXPECT_EQ(render(scene, budgeted).statistics.passes, 1u);
}

TEST_P(Edge, InterruptLeavesNoPixelOut) {
    // More pixels than fit in one batch.
    const Scene scene = box_scene(emitter(glm::vec3(1)));
    const RenderResult result =
        argand::render(device(), scene, settings(512, 16), [](double) { return false; });
    EXPECT_TRUE(result.statistics.interrupted);
    EXPECT_EQ(result.statistics.samples, has_map(GetParam()) ? 8u : 1u);
    for (const glm::vec3& pixel : layer(result, "").pixels) {
        ASSERT_EQ(pixel, glm::vec3(1));
    }
}

TEST_P(Edge, ManySamplesOfTheSameRadianceAddUp) {
    // Plain sums in single precision would be off by 1 %.
    const Scene scene = box_scene(emitter(glm::vec3(0.1f)));
    EXPECT_RELATIVE(mean(layer(render(scene, settings(1, 1'000'000)), "")).g, 0.1, 1e-6);
}

TEST_P(Edge, FilmsLargerThanAKernelCanAddress) {
    const Scene scene = room_scene();
    Device& small = open({"small", "", "storage_range=1MiB"});
    const RenderResult parts = testing::render(small, scene, settings(128, 2));
    const RenderResult whole = render(scene, settings(128, 2));
    EXPECT_TRUE(same_bits(layer(parts, "direct"), layer(whole, "direct")));
}

TEST_P(Edge, ProgressGrowsToTheEnd) {
    double last = 0;
    argand::render(device(), room_scene(), settings(64, 64), [&](double done) {
        EXPECT_GT(done, last);
        last = done;
        return true;
    });
    EXPECT_NEAR(last, 1, 1e-9);
}

INSTANTIATE_METHODS(Edge);

using PhotonEdge = RenderTest;

TEST_F(PhotonEdge, NoPhotonsLeaveTheDirectLight) {
    RenderSettings settings = settings_of("photons", 16, 4);
    settings.photons = 0;
    const RenderResult none = render(room_scene(), settings);
    EXPECT_GT(mean(layer(none, "direct")).g, 0);
    EXPECT_EQ(mean(layer(none, "indirect")), glm::dvec3(0));
    settings.photons = 1;
    const RenderResult one = render(room_scene(), settings);
    EXPECT_EQ(one.statistics.photons_emitted, 1u);
    EXPECT_TRUE(same_bits(layer(one, "direct"), layer(none, "direct")));
}

TEST_F(PhotonEdge, PassesAreIndependentEstimatesOfTheSame) {
    const Scene scene = room_scene();
    RenderSettings settings = settings_of("photons", 16, 16);
    settings.photons = 100'000;
    settings.radius = 0.1;
    const glm::dvec3 whole = mean(layer(render(scene, settings), "indirect"));
    Device& limited = open({"limited", "", "storage_range=1MiB"});
    // A pass of the few remaining photons must not count as much as a full one.
    for (const std::uint64_t photons : {100'000ull, 100'001ull, 87'377ull}) {
        settings.photons = photons;
        const RenderResult result = testing::render(limited, scene, settings);
        EXPECT_GT(result.statistics.passes, 1u);
        EXPECT_EQ(result.statistics.photons_emitted, photons);
        EXPECT_EQ(result.statistics.non_finite, 0u);
        EXPECT_GE(result.statistics.samples, 16u);
        const glm::dvec3 passes = mean(layer(result, "indirect"));
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_RELATIVE(passes[channel], whole[channel], 0.03) << photons;
        }
    }
}

TEST_F(PhotonEdge, EveryPassHasASampleSoThatMemoryDoesNotGrowWithPhotons) {
    RenderSettings settings = settings_of("photons", 8, 1);
    settings.photons_per_pass = 1000;
    for (const std::uint64_t photons : {1000u, 7001u}) {
        settings.photons = photons;
        const RenderResult result = render(room_scene(), settings);
        const std::uint64_t passes = (photons + 999) / 1000;
        EXPECT_EQ(result.statistics.passes, passes);
        EXPECT_EQ(result.statistics.samples, passes);
        EXPECT_EQ(result.statistics.photons_emitted, photons);
    }
}

TEST_F(PhotonEdge, SlowPassesGrowSmallerWhereEveryPhotonIsStoredOften) {
    // Walls that reflect almost everything store each photon far more often than the buffers
    // provide for.
    Scene scene = load_asset("closed_box.gltf");
    for (Material& material : scene.materials) {
        material.base_color = glm::vec3(0.97f);
    }
    Device& small = open({"small", "", "storage_range=1MiB"});
    RenderSettings settings = settings_of("photons", 4, 16);
    settings.photons = 20'000;
    const RenderResult result = testing::render(small, scene, settings);
    EXPECT_GT(result.statistics.passes, 10u);
    EXPECT_EQ(result.statistics.photons_emitted, settings.photons);
    // L = Le / (1 - albedo)
    EXPECT_RELATIVE(mean(layer(result, "")).g, 0.25 / (1 - 0.97), 0.05);
}

TEST_F(PhotonEdge, UnknownMethodIsAUsageError) {
    RenderSettings settings = settings_of("photon", 4, 1);
    try {
        render(room_scene(), settings);
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("photons, "));
    }
}

} // namespace
} // namespace argand::testing
