// Where the samples of the surfaces' area lie, which tell estimates how much of a disc is covered.
#include "device_fixture.hpp"
#include "methods/scenes.hpp"
#include "photon/map_queries.hpp"
#include "photon/photon_map.hpp"
#include "shared/photon.h"
#include "world/world.hpp"

#include <algorithm>
#include <array>
#include <random>

namespace argand::testing {
namespace {

class AreaSamples : public DeviceTest {
protected:
    std::vector<PhotonRecord> samples(const Scene& scene, std::uint64_t count,
                                      std::uint32_t seed = 0, double cover_height = 0,
                                      std::uint64_t slots = 0) {
        Device& device = open();
        const DeviceScene on_device =
            upload_scene(device, scene, make_plan(scene, {.everything = true}));
        PhotonWorkspace workspace = make_photon_workspace(device, slots > 0 ? slots : count);
        const PhotonMap map = build_photon_map(
            device, on_device, workspace, store(device, workspace, {PhotonRecord{}}),
            {.area_samples = count, .cover_height = cover_height, .seed = seed});
        std::vector<PhotonRecord> found =
            download<PhotonRecord>(device, map.photons, map.area_samples + 1);
        std::erase_if(found,
                      [](const PhotonRecord& r) { return (r.normal & area_sample_bit) == 0; });
        return found;
    }
};

TEST_F(AreaSamples, LieOnlyWherePhotonsAreStored) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 1);
    const auto add_at = [&](float y, const Material& material) {
        add_quad(scene, {-1, y, 1}, {2, 0, 0}, {0, 0, -2}, add_material(scene, material));
    };
    add_at(1, mirror());
    add_at(2, emitter(glm::vec3(1)));
    add_at(3, glass(1.5f, false));
    const std::vector<PhotonRecord> found = samples(scene, 1000);
    double area = 0;
    for (const PhotonRecord& sample : found) {
        EXPECT_NEAR(sample.y, 0, 1e-5);
        area += sample.flux_r;
    }
    EXPECT_NEAR(area, 4, 1e-3);
}

TEST_F(AreaSamples, NoneWherePhotonsAreStoredNowhere) {
    EXPECT_TRUE(samples(floor_scene(mirror(), 1), 100).empty());
}

// Cells of one size should hold the same number of samples, whatever the order of the triangles.
TEST_F(AreaSamples, AreEvenWhateverTheOrderOfTriangles) {
    constexpr int cells = 16, per_cell = 16, triangles = 96;
    Scene scene;
    const std::uint32_t material = add_material(scene, lambertian(glm::vec3(0.5f)));
    const float step = 2.0f / triangles;
    for (int x = 0; x < triangles; ++x) {
        for (int z = 0; z < triangles; ++z) {
            add_quad(scene,
                     {-1 + step * static_cast<float>(x), 0, -1 + step * static_cast<float>(z + 1)},
                     {step, 0, 0}, {0, 0, -step}, material);
        }
    }
    std::mt19937 random(3);
    std::shuffle(scene.triangles.begin(), scene.triangles.end(), random);
    std::vector<int> counts(cells * cells);
    for (const PhotonRecord& sample : samples(scene, cells * cells * per_cell)) {
        const auto cell = [](float x) {
            return std::clamp(static_cast<int>((x + 1) / 2 * cells), 0, cells - 1);
        };
        ++counts[static_cast<std::size_t>(cell(sample.x) * cells + cell(sample.z))];
    }
    double variance = 0;
    for (const int count : counts) {
        variance += std::pow(count - per_cell, 2) / (cells * cells);
    }
    // In the order of the file it is 12: a triangle has a sample or none, whatever its neighbours
    // have.
    EXPECT_LT(variance, 0.3);
}

// A triangle has a whole number of samples, which must not be the same one with every seed.
TEST_F(AreaSamples, AreUnbiasedOnEveryWall) {
    const Scene scene = box_scene(lambertian(glm::vec3(0.5f)));
    constexpr int seeds = 64, count = 172;
    std::array<double, 6> counts{};
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        for (const PhotonRecord& sample : samples(scene, count, seed)) {
            const glm::vec3 n = unpack_photon_normal(sample.normal);
            const glm::vec3 size = glm::abs(n);
            const int axis = size.x > 0.5f ? 0 : size.y > 0.5f ? 1 : 2;
            counts[static_cast<std::size_t>(2 * axis + (n[axis] > 0 ? 1 : 0))] += 1;
        }
    }
    for (const double wall : counts) {
        EXPECT_NEAR(wall / seeds, count / 6.0, 0.3); // 30 on some walls without a random start
    }
}

/// A floor at height 0, and a panel over the half of it with x > 0.
Scene floor_with_panel(float height, const Material& panel) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 1);
    add_quad(scene, {0, height, 1}, {1, 0, 0}, {0, 0, -2}, add_material(scene, panel));
    return scene;
}

// A panel a centimetre over a floor takes the front from the floor's samples, and the floor takes
// the back from the panel's. The rays are traced in batches of any size.
TEST_F(AreaSamples, CoveredSidesHaveNoArea) {
    const Scene scene = floor_with_panel(0.01f, lambertian(glm::vec3(0.5f)));
    for (const std::uint64_t slots : {0u, 1u, 7u}) {
        SCOPED_TRACE(slots);
        for (const PhotonRecord& sample : samples(scene, 101, 0, 0.02, slots)) {
            const bool on_panel = sample.y > 0.005f;
            EXPECT_EQ(sample.flux_r > 0, on_panel || sample.x < 0) << sample.x;
            EXPECT_EQ(sample.flux_g > 0, !on_panel) << sample.x;
        }
    }
}

TEST_F(AreaSamples, NothingCoversBeyondTheHeightOrThroughGlass) {
    for (const Scene& scene : {floor_with_panel(0.03f, lambertian(glm::vec3(0.5f))),
                               floor_with_panel(0.01f, glass(1.5f, false))}) {
        for (const PhotonRecord& sample : samples(scene, 100, 0, 0.02)) {
            EXPECT_GT(sample.flux_r, 0);
            EXPECT_GT(sample.flux_g, 0);
        }
    }
}

double open_area(const std::vector<PhotonRecord>& samples, float PhotonRecord::*side) {
    double area = 0;
    for (const PhotonRecord& sample : samples) {
        area += sample.*side;
    }
    return area;
}

/// A floor of 2 m by 2 m, and another one that fills the same square by triangles of other shapes.
Scene floor_and_copy(bool faces_down) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 1);
    const glm::vec3 corners[] = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
    const glm::vec3 middle(0.3f, 0, 0.2f);
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 a = corners[i], b = corners[(i + 1) % 4];
        add_triangle(scene, faces_down ? b : a, faces_down ? a : b, middle, 0);
    }
    return scene;
}

// Rays go on behind the faces of the pane.
TEST_F(AreaSamples, APanelUnderGlassCoversTheFloor) {
    Scene scene = floor_with_panel(0.01f, lambertian(glm::vec3(0.5f)));
    const std::uint32_t pane = add_material(scene, glass(1.5f, true));
    for (const float height : {0.014f, 0.018f}) {
        add_quad(scene, {0, height, 1}, {1, 0, 0}, {0, 0, -2}, pane);
    }
    for (const PhotonRecord& sample : samples(scene, 100, 0, 0.03)) {
        EXPECT_EQ(sample.flux_r > 0, sample.y > 0.005f || sample.x < 0) << sample.x;
    }
}

// Photons lie on one of two surfaces in the same place, so that only one of their areas may count.
// Rounding decides which, and favours the triangle from which the sample was computed a little.
TEST_F(AreaSamples, CopiesOfASurfaceAddNoArea) {
    const std::vector<PhotonRecord> found = samples(floor_and_copy(false), 20'000, 0, 0.02);
    EXPECT_NEAR(open_area(found, &PhotonRecord::flux_r), 4, 0.25);
    EXPECT_NEAR(open_area(found, &PhotonRecord::flux_g), 4, 0.25);
}

// Queries count the samples of surfaces that face as their own does.
TEST_F(AreaSamples, SurfacesBackToBackKeepTheirAreas) {
    const std::vector<PhotonRecord> found = samples(floor_and_copy(true), 20'000, 0, 0.02);
    EXPECT_NEAR(open_area(found, &PhotonRecord::flux_r), 8, 0.01);
    EXPECT_NEAR(open_area(found, &PhotonRecord::flux_g), 8, 0.01);
}

// Triangles of a centimetre on a floor of 2 m, 1,000 m from the origin: rounded samples lie on the
// edges of their triangles, and beyond.
TEST_F(AreaSamples, SmallTrianglesLoseNoAreaToTheirNeighbours) {
    Scene scene;
    const std::uint32_t material = add_material(scene, lambertian(glm::vec3(0.5f)));
    constexpr int side = 200;
    const float step = 2.0f / side;
    for (int i = 0; i < side * side; ++i) {
        const glm::vec3 corner(1000 + step * static_cast<float>(i % side), 0,
                               1000 + step * static_cast<float>(i / side));
        add_quad(scene, corner, {0, 0, step}, {step, 0, 0}, material);
    }
    const std::vector<PhotonRecord> found = samples(scene, 50'000, 0, 0.02);
    EXPECT_NEAR(open_area(found, &PhotonRecord::flux_r), 4, 0.04);
    EXPECT_NEAR(open_area(found, &PhotonRecord::flux_g), 4, 0.04);
}

// Photons lie on the panel only. Its irradiance is theirs, not half of it.
TEST_F(AreaSamples, HiddenSurfacesDarkenNoEstimate) {
    const Scene scene = floor_with_panel(0.01f, lambertian(glm::vec3(0.5f)));
    Device& device = open();
    const DeviceScene on_device =
        upload_scene(device, scene, make_plan(scene, {.everything = true}));
    constexpr int side = 100;
    std::vector<PhotonRecord> photons;
    for (int i = 0; i < side * side; ++i) {
        const float x = (static_cast<float>(i % side) + 0.5f) / side;
        const float z = 2 * (static_cast<float>(i / side) + 0.5f) / side - 1;
        const float flux = 2.0f / (side * side); // an irradiance of 1
        photons.push_back({x, 0.01f, z, pack_photon_normal({0, 1, 0}, false), flux, flux, flux,
                           pack_photon_direction({0, 1, 0}, 1, 0)});
    }
    PhotonWorkspace workspace = make_photon_workspace(device, photons.size());
    const double radius = 0.3;
    const PhotonMap map = build_photon_map(
        device, on_device, workspace, store(device, workspace, photons),
        {.area_samples = 10'000, .cover_height = disc_half_height * radius, .seed = 0});
    RadiusEstimator estimator(device, on_device.plan, {radius, radius});
    bool finished = false;
    const Answering how{.albedo = 0.5f};
    for (const Gathered& sum : answers(
             device, estimator, map,
             {{{0.5f, 0.01f, 0}}, {{0.98f, 0.01f, 0}}, {{0.5f, 0.01f, 0.99f}}}, how, finished)) {
        EXPECT_NEAR(sum.indirect.r, 0.5 / double(pi), 0.03 * 0.5 / double(pi));
    }
    EXPECT_TRUE(finished);
}

/// What is found beside the panel on a floor of irradiance 1, where there is a hundred times the
/// light under the panel. caustic: that light is. slots: photons whose rays are traced together.
/// drops: covered photons are not in the map.
double beside_a_bright_gap(Device& device, const Material& panel, bool caustic, std::uint64_t slots,
                           bool drops = true) {
    const Scene scene = floor_with_panel(0.01f, panel);
    const DeviceScene on_device =
        upload_scene(device, scene, make_plan(scene, {.everything = true}));
    constexpr int side = 100;
    std::vector<PhotonRecord> photons;
    for (int i = 0; i < side * side; ++i) {
        const float x = 2 * (static_cast<float>(i % side) + 0.5f) / side - 1;
        const float z = 2 * (static_cast<float>(i / side) + 0.5f) / side - 1;
        const float flux = (x > 0 ? 100 : 1) * 4.0f / (side * side);
        photons.push_back({x, 0, z, pack_photon_normal({0, 1, 0}, caustic && x > 0), flux, flux,
                           flux, pack_photon_direction({0, 1, 0}, 1, 0)});
    }
    PhotonWorkspace workspace = make_photon_workspace(device, photons.size());
    workspace.slots = slots;
    const double radius = 0.3;
    const PhotonMap map =
        build_photon_map(device, on_device, workspace, store(device, workspace, photons),
                         {.area_samples = 10'000,
                          .cover_height = disc_half_height * radius,
                          .drops_covered = drops,
                          .seed = 0});
    RadiusEstimator estimator(device, on_device.plan, {radius, radius});
    bool finished = false;
    const Gathered sum =
        answers(device, estimator, map, {{{-0.05f, 0, 0}}}, Answering{.albedo = 0.5f}, finished)[0];
    EXPECT_TRUE(finished);
    return (sum.indirect.r + sum.caustic.r) * double(pi) / 0.5;
}

TEST_F(AreaSamples, LightInAGapLeaksIntoNoEstimate) {
    const Material white = lambertian(glm::vec3(0.5f));
    for (const std::uint64_t slots : {1000u, 10'000u}) {
        EXPECT_NEAR(beside_a_bright_gap(open(), white, false, slots), 1, 0.03) << slots;
    }
}

// The area in the gap does not count, so the light leaks if it does.
TEST_F(AreaSamples, LightInAGapLeaksIfItCounts) {
    EXPECT_GT(beside_a_bright_gap(open(), lambertian(glm::vec3(0.5f)), false, 10'000, false), 20);
}

// Light passes through glass, so that what it covers is not apart. Caustics are sharp anyway.
TEST_F(AreaSamples, LightUnderGlassAndCausticsCount) {
    EXPECT_GT(beside_a_bright_gap(open(), glass(1.5f, true), false, 10'000), 20);
    EXPECT_GT(beside_a_bright_gap(open(), lambertian(glm::vec3(0.5f)), true, 10'000), 20);
}

TEST_F(AreaSamples, DifferBetweenSeeds) {
    const Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 1);
    const std::vector<PhotonRecord> a = samples(scene, 100, 1), b = samples(scene, 100, 2);
    ASSERT_EQ(a.size(), b.size());
    std::size_t same = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        same += a[i].x == b[i].x && a[i].z == b[i].z ? 1 : 0;
    }
    EXPECT_LT(same, 5u);
}

} // namespace
} // namespace argand::testing
