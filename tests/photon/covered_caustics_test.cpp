// Caustics at edges: of a footprint or a disc that lies half beside the surface, only a half
// counts.
#include "device_fixture.hpp"
#include "methods/scenes.hpp"
#include "photon/area_tree.hpp"
#include "photon/map_queries.hpp"
#include "photon/nearest.hpp"
#include "shared/accel_records.h"
#include "shared/footprint.h"
#include "world/world.hpp"

#include <cmath>
#include <random>

namespace argand::testing {
namespace {

constexpr float radius = 0.2f; // of footprints and discs; the floor is 2 m wide

/// Share of a disc at this distance from a straight edge that lies on the surface, with
/// Epanechnikov's kernel: the integral over strips parallel to the edge.
double share_at(double distance) {
    constexpr int steps = 2000;
    double sum = 0, whole = 0;
    for (int i = 0; i < steps; ++i) {
        const double x = (i + 0.5) / steps * 2 - 1;
        const double strip = std::pow(1 - x * x, 1.5);
        whole += strip;
        sum += x * double(radius) < distance ? strip : 0;
    }
    return sum / whole;
}

class CoveredCaustics : public DeviceTest {
protected:
    PhotonRecord caustic_at(float x, float z, float y = 0, glm::vec3 normal = {0, 1, 0}) {
        return {x, y, z, pack_photon_normal(normal, true), 1, 1, 1, pack_unit(normal)};
    }

    float uniform(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random_);
    }

    /// The map of photons with round footprints.
    PhotonMap footprint_map(const std::vector<PhotonRecord>& photons, std::uint64_t area_samples,
                            float size = radius,
                            const Scene& scene = floor_scene(lambertian(glm::vec3(0.5f)), 1)) {
        Device& on = open();
        const DeviceScene uploaded =
            upload_scene(on, scene, make_plan(scene, {.everything = true}));
        PhotonWorkspace workspace = make_photon_workspace(on, photons.size() + area_samples,
                                                          {.extents = extents_differentials});
        std::vector<glm::uvec4> offsets;
        for (const PhotonRecord& p : photons) {
            const Frame frame = make_frame(unpack_photon_normal(p.normal));
            offsets.emplace_back(pack_dual(frame.x * size), pack_dual(frame.y * size));
        }
        FootprintScale scale{};
        scale.spacing = scale.diffuse = scale.caustic = scale.flatness = 1;
        scale.radius_min = scale.caustic_min = 1e-4f;
        scale.radius_max = scale.caustic_max = 1;
        return build_photon_map(on, uploaded, workspace, store(on, workspace, photons, offsets),
                                {.area_samples = area_samples,
                                 .cover_height = 0.1 * double(size),
                                 .footprints = scale});
    }

    /// The mean flux of the map's caustic photons.
    double mean_flux(const PhotonMap& map, std::size_t photons) {
        double sum = 0;
        std::size_t found = 0;
        for (const PhotonRecord& p :
             download<PhotonRecord>(open(), map.photons, photons + map.area_samples)) {
            if ((p.normal & area_sample_bit) == 0) {
                sum += double(p.flux_g);
                ++found;
            }
        }
        EXPECT_EQ(found, photons);
        return sum / static_cast<double>(found);
    }

    /// Photons at this distance from the floor's edge x = 1, away from the corners.
    std::vector<PhotonRecord> photons_from_edge(float distance, std::size_t count = 200) {
        std::vector<PhotonRecord> photons;
        for (std::size_t i = 0; i < count; ++i) {
            photons.push_back(caustic_at(1 - distance, uniform(-0.7f, 0.7f)));
        }
        return photons;
    }

    std::mt19937 random_{7};
};

TEST_F(CoveredCaustics, FootprintsKeepTheirFlux) {
    for (const float distance : {0.0f, 0.05f, 0.1f, 0.15f, 0.5f}) {
        const PhotonMap map = footprint_map(photons_from_edge(distance), 4001);
        EXPECT_RELATIVE(mean_flux(map, 200), 1 / share_at(double(distance)), 0.03) << distance;
    }
}

TEST_F(CoveredCaustics, AFootprintInACornerHasFourTimesItsFlux) {
    const PhotonMap map = footprint_map(std::vector(100, caustic_at(1, 1)), 20'000);
    EXPECT_RELATIVE(mean_flux(map, 100), 4.0, 0.1);
}

TEST_F(CoveredCaustics, TheBackOfASurfaceHasItsOwnSamples) {
    std::vector<PhotonRecord> photons;
    for (const PhotonRecord& p : photons_from_edge(0)) {
        photons.push_back(caustic_at(p.x, p.z, 0, {0, -1, 0}));
    }
    Material leaf = lambertian(glm::vec3(0.5f));
    leaf.double_sided = true;
    EXPECT_RELATIVE(mean_flux(footprint_map(photons, 4000, radius, floor_scene(leaf, 1)), 200), 2.0,
                    0.03);
}

TEST_F(CoveredCaustics, OtherSurfacesDoNotCount) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 1);
    add_quad(scene, {1, -1, 1}, {0, 0, -2}, {0, 2, 0}, 0);   // a wall along the edge
    add_quad(scene, {1, 0.1f, 1}, {1, 0, 0}, {0, 0, -2}, 0); // a step behind it
    EXPECT_RELATIVE(mean_flux(footprint_map(photons_from_edge(0), 10'000, radius, scene), 200), 2.0,
                    0.03);
}

// Other light is taken from what a panel close above covers; caustic photons stay there.
TEST_F(CoveredCaustics, CoveredPlacesCount) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 1);
    add_quad(scene, {0, 0.01f, 1}, {1, 0, 0}, {0, 0, -2}, 0);
    std::vector<PhotonRecord> photons;
    for (int i = 0; i < 200; ++i) {
        photons.push_back(caustic_at(0, uniform(-0.7f, 0.7f)));
    }
    EXPECT_RELATIVE(mean_flux(footprint_map(photons, 8000, radius, scene), 200), 1.0, 0.03);
}

// Each is a surface with two sides, but light meets only one of them.
TEST_F(CoveredCaustics, CopiesThatFaceTheOtherWayCountOnce) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 1);
    const std::size_t triangles = scene.triangles.size();
    for (std::size_t i = 0; i < triangles; ++i) {
        const glm::uvec3 t = scene.triangles[i];
        add_triangle(scene, scene.positions[t.x], scene.positions[t.z], scene.positions[t.y], 0);
    }
    for (const float distance : {0.0f, 0.5f}) {
        EXPECT_RELATIVE(
            mean_flux(footprint_map(photons_from_edge(distance), 8000, radius, scene), 200),
            1 / share_at(double(distance)), 0.03)
            << distance;
    }
}

// Too few samples tell nothing; many more than are looked at tell the same.
TEST_F(CoveredCaustics, AnyNumberOfAreaSamples) {
    const std::vector<PhotonRecord> photons = photons_from_edge(0);
    for (const std::uint64_t samples : {0u, 2u, 7u, 200u}) {
        EXPECT_EQ(mean_flux(footprint_map(photons, samples), 200), 1) << samples;
    }
    EXPECT_RELATIVE(mean_flux(footprint_map(photons, 200'000), 200), 2.0, 0.03);
    EXPECT_EQ(mean_flux(footprint_map(photons, 4000, 0.01f), 200), 1); // small footprints
}

TEST_F(CoveredCaustics, OnePhotonOrAnOddNumber) {
    EXPECT_RELATIVE(mean_flux(footprint_map({caustic_at(1, 0)}, 4000), 1), 2.0, 0.2);
    EXPECT_RELATIVE(mean_flux(footprint_map(photons_from_edge(0, 333), 4000), 333), 2.0, 0.03);
}

/// Estimates of an evenly lit floor.
class CoveredDiscs : public CoveredCaustics {
protected:
    static constexpr int photons_across = 200;

    /// Means of the caustic layer, over what they are far from edges.
    template <class Make>
    void expect_even_light(const Make& make_estimator, std::uint32_t part, double tolerance) {
        Device& on = open();
        const Scene floor = floor_scene(lambertian(glm::vec3(0.5f)), 1);
        const DeviceScene scene = upload_scene(on, floor, make_plan(floor, {.everything = true}));
        std::vector<PhotonRecord> photons;
        for (int i = 0; i < photons_across * photons_across; ++i) {
            photons.push_back(caustic_at(uniform(-1, 1), uniform(-1, 1)));
        }
        constexpr std::uint64_t samples = 4000;
        PhotonWorkspace workspace = make_photon_workspace(on, photons.size() + samples);
        const PhotonMap map = build_photon_map(on, scene, workspace, store(on, workspace, photons),
                                               {.area_samples = samples, .caustic_radius = radius});
        const std::unique_ptr<PhotonEstimator> estimator = make_estimator(on, scene);
        for (const float distance : {0.001f, 0.1f, 0.5f}) {
            std::vector<testing::Query> queries;
            for (int i = 0; i < 100; ++i) {
                queries.push_back({{1 - distance, 0, uniform(-0.7f, 0.7f)}});
            }
            bool finished = false;
            double sum = 0;
            for (const Gathered& g :
                 answers(on, *estimator, map, queries, {.part = part}, finished)) {
                sum += g.caustic.g / 100;
            }
            // Photons of flux 1, albedo 0.5.
            const double even = photons_across * photons_across / 4.0 * 0.5 / double(pi);
            EXPECT_RELATIVE(sum, even, tolerance) << distance;
        }
    }
};

TEST_F(CoveredDiscs, OfAFixedRadius) {
    for (const std::uint32_t part : {map_whole, map_caustic}) {
        expect_even_light(
            [&](Device& on, const DeviceScene& scene) {
                return std::make_unique<RadiusEstimator>(on, scene.plan,
                                                         GatherRadii{2 * radius, radius});
            },
            part, 0.04);
    }
}

TEST_F(CoveredDiscs, OfTheNearestPhotons) {
    expect_even_light(
        [&](Device& on, const DeviceScene& scene) {
            return std::make_unique<NearestEstimator>(
                on, scene.plan,
                NearestSettings{.neighbours = 100,
                                .radius = 2 * radius,
                                .caustic_neighbours = photons_across * photons_across / 40,
                                .caustic_radius = radius});
        },
        map_caustic, 0.04);
}

class AreaTrees : public DeviceTest, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(AreaTrees, HoldAllSamplesInOrder) {
    Device& on = open();
    std::mt19937 random(3);
    std::vector<PhotonRecord> records;
    std::vector<std::uint32_t> expected;
    while (expected.size() < GetParam()) {
        const auto coordinate = [&] { return static_cast<float>(random()) * 0x1p-32f; };
        const bool sample = random() % 3 == 0;
        if (sample) {
            expected.push_back(static_cast<std::uint32_t>(records.size()));
        }
        records.push_back({coordinate(), coordinate(), coordinate(),
                           pack_photon_normal({0, 1, 0}, false) | (sample ? area_sample_bit : 0u)});
    }
    records.push_back({2, 2, 2, pack_photon_normal({0, 1, 0}, false)});
    std::vector<std::uint32_t> counters(counter_count, 0);
    counters[counter_stored] = static_cast<std::uint32_t>(records.size());
    const AreaTree tree = build_area_tree(on, upload(on, "records", records),
                                          upload(on, "counters", counters), GetParam());
    ASSERT_EQ(tree.samples, GetParam());
    EXPECT_EQ(download<std::uint32_t>(on, tree.places, GetParam()), expected);
    const std::uint32_t blocks = (GetParam() + area_block - 1) / area_block;
    if (blocks == 0) {
        return;
    }
    // The whole tree, by escape references, to each block once.
    const auto nodes = download<LbvhNode>(on, tree.lbvh.nodes, 2 * std::size_t(blocks));
    std::vector<int> visits(blocks, 0);
    std::uint32_t at = blocks > 1 ? 0 : 1;
    while (at != lbvh_end) {
        const LbvhNode& node = nodes[at];
        if (at % 2 == 0) {
            at = node.child;
            continue;
        }
        ASSERT_LT(node.child, blocks);
        ++visits[node.child];
        for (std::size_t k = std::size_t(node.child) * area_block;
             k < std::min<std::size_t>(expected.size(), (node.child + std::size_t(1)) * area_block);
             ++k) {
            const PhotonRecord& sample = records[expected[k]];
            EXPECT_TRUE(sample.x >= node.low_x && sample.x <= node.high_x);
            EXPECT_TRUE(sample.y >= node.low_y && sample.y <= node.high_y);
            EXPECT_TRUE(sample.z >= node.low_z && sample.z <= node.high_z);
        }
        at = node.escape;
    }
    EXPECT_EQ(visits, std::vector<int>(blocks, 1));
}

INSTANTIATE_TEST_SUITE_P(Sizes, AreaTrees, ::testing::Values(0u, 1u, 7u, 8u, 9u, 333u, 20'000u));

} // namespace
} // namespace argand::testing
