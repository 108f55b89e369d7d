// Density estimation in discs by simultaneous search, against the estimates that go through the
// tree, which tests compare with sums in double precision.
#include "photon/frontier_settings.hpp"
#include "photon/map_queries.hpp"
#include "shared/photon.h"
#include "world/world.hpp"

#include <algorithm>
#include <numbers>
#include <optional>
#include <random>

namespace argand::testing {
namespace {

constexpr float disc_albedo = 0.5f;

/// How discs are estimated.
struct Discs {
    GatherRadii radii{0.2, 0.2};
    DiscSettings disc;
    std::uint32_t part = map_whole;
    std::uint64_t area_samples = 0;
    std::uint32_t budget = gather_budget;
};

class SimultaneousDiscs : public RenderTest {
protected:
    SimultaneousDiscs() : random_(23) {}

    float uniform(float low = -1, float high = 1) {
        return std::uniform_real_distribution<float>(low, high)(random_);
    }
    /// A point of a bumpy floor, and the normal there.
    Query on_floor() {
        return {{uniform(), uniform(-0.01f, 0.01f), uniform()},
                glm::normalize(glm::vec3(uniform(-0.2f, 0.2f), 1, uniform(-0.2f, 0.2f)))};
    }
    std::vector<Query> on_floor(std::size_t count) {
        std::vector<Query> queries(count);
        std::generate(queries.begin(), queries.end(), [&] { return on_floor(); });
        return queries;
    }
    PhotonRecord photon(const Query& at, bool caustic) {
        const glm::vec3 p = at.position;
        return {.x = p.x,
                .y = p.y,
                .z = p.z,
                .normal = pack_photon_normal(at.normal, caustic),
                .flux_r = uniform(0.1f, 1),
                .flux_g = uniform(0.1f, 1),
                .flux_b = uniform(0.1f, 1),
                .direction = pack_unit(glm::normalize(glm::vec3(uniform(), 0.5f, uniform())))};
    }
    std::vector<PhotonRecord> bumpy_photons(std::size_t count) {
        std::vector<PhotonRecord> photons;
        photons.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            photons.push_back(photon(on_floor(), i % 3 == 0));
            photons.back().normal = i % 7 == 2 ? no_photon : photons.back().normal;
        }
        return photons;
    }

    /// frontier: none for estimates through the tree.
    static std::vector<Gathered> estimates(Device& device, const std::vector<PhotonRecord>& photons,
                                           const std::vector<Query>& queries, const Discs& how,
                                           const std::optional<FrontierSettings>& frontier) {
        const DeviceScene scene =
            upload_scene(device, floor_scene(lambertian(glm::vec3(disc_albedo)), 1),
                         make_plan({}, {.everything = true}));
        PhotonWorkspace workspace = make_photon_workspace(device, photons.size());
        const PhotonMap map =
            build_photon_map(device, scene, workspace, store(device, workspace, photons),
                             {.area_samples = how.area_samples, .frontier = frontier});
        EXPECT_EQ(map.area_samples > 0, how.area_samples > 0);
        RadiusEstimator estimator(device, scene.plan, how.radii, how.budget, how.disc);
        bool finished = false;
        return answers(device, estimator, map, queries, {.part = how.part, .albedo = disc_albedo},
                       finished);
    }

    static void expect_near(const std::vector<Gathered>& found,
                            const std::vector<Gathered>& expected) {
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_RELATIVE(found[i].indirect[channel], expected[i].indirect[channel], 1e-5)
                    << i;
                EXPECT_RELATIVE(found[i].caustic[channel], expected[i].caustic[channel], 1e-5) << i;
            }
        }
    }

    std::mt19937 random_;
};

TEST_F(SimultaneousDiscs, EqualThoseOfTheTree) {
    const std::vector<PhotonRecord> photons = bumpy_photons(3001);
    const std::vector<Query> queries = on_floor(403);
    const DiscSettings discs[] = {{}, {.uniform_kernel = true}, {.ball = true}};
    for (const DiscSettings& disc : discs) {
        for (const std::uint32_t part : {map_whole, map_indirect, map_caustic}) {
            for (const double caustic_radius : {0.2, 0.07}) {
                for (const std::uint64_t area_samples : {0u, 3000u}) {
                    SCOPED_TRACE(::testing::Message()
                                 << "uniform " << disc.uniform_kernel << ", ball " << disc.ball
                                 << ", part " << part << ", caustic radius " << caustic_radius
                                 << ", area samples " << area_samples);
                    const Discs how{.radii = {0.2, caustic_radius},
                                    .disc = disc,
                                    .part = part,
                                    .area_samples = area_samples};
                    const auto tree = estimates(device(), photons, queries, how, {});
                    const auto found =
                        estimates(device(), photons, queries, how, FrontierSettings());
                    expect_near(found, tree);
                    EXPECT_EQ(tree[0].indirect.g > 0, part != map_caustic);
                    EXPECT_EQ(tree[0].caustic.g > 0, part != map_indirect);
                }
            }
        }
    }
}

// Batches of photons add up, and parts that wait.
TEST_F(SimultaneousDiscs, LittleMemoryAndSmallBudgetsDoNotChangeThem) {
    const std::vector<PhotonRecord> photons = bumpy_photons(7000);
    const std::vector<Query> queries = on_floor(300);
    Discs how{.radii = {0.2, 0.1}, .area_samples = 3000};
    const auto tree = estimates(device(), photons, queries, how, {});
    const FrontierSettings plenty;
    const FrontierSettings little{.partition_cost = 0, .memory = least_frontier_memory};
    const FrontierSettings some{.query_leaf = 1, .memory = 3 * least_frontier_memory};
    for (const FrontierSettings& settings : {plenty, little, some}) {
        for (const std::uint32_t budget : {100u, gather_budget}) {
            how.budget = budget;
            SCOPED_TRACE(::testing::Message() << settings.memory << " bytes, budget " << budget);
            expect_near(estimates(device(), photons, queries, how, settings), tree);
        }
    }
}

TEST_F(SimultaneousDiscs, NoPhotonsOrNoQueries) {
    const Gathered none;
    for (const Gathered& sum : estimates(device(), {}, on_floor(70), {}, FrontierSettings())) {
        EXPECT_EQ(sum, none);
    }
    EXPECT_TRUE(estimates(device(), bumpy_photons(70), {}, {}, FrontierSettings()).empty());
}

// An invocation may not loop over all of them.
TEST_F(SimultaneousDiscs, MillionInOnePoint) {
    constexpr std::size_t count = 1'000'003;
    constexpr double radius = 0.5;
    const Query at{{0.25f, 0, -0.5f}, {0, 1, 0}};
    PhotonRecord record = photon(at, false);
    record.flux_r = 0.3f;
    const std::vector<PhotonRecord> photons(count, record);
    const std::vector<Query> queries{at, {{0.5f, 0, -0.5f}, {0, 1, 0}}, {{-0.5f, 0, -0.5f}}};
    for (const std::uint32_t budget : {3000u, gather_budget}) {
        const auto found =
            estimates(device(), photons, queries, {.radii = {radius, radius}, .budget = budget},
                      FrontierSettings());
        // Epanechnikov's kernel: 2 / (π r²) at the centre, and 3/4 of it at half the radius.
        const double pi2r2 = std::numbers::pi * std::numbers::pi * radius * radius;
        const double at_center = double(count) * 0.3f * disc_albedo * 2 / pi2r2;
        EXPECT_RELATIVE(found[0].indirect.r, at_center, 1e-5);
        EXPECT_RELATIVE(found[1].indirect.r, 0.75 * at_center, 1e-5);
        EXPECT_EQ(found[2], Gathered());
    }
}

} // namespace
} // namespace argand::testing
