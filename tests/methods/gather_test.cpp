// Density estimation over given photons, against the sum in double precision.
#include "rendering.hpp"

#include "photon/map_queries.hpp"
#include "shared/photon.h"
#include "world/world.hpp"

#include <random>

namespace argand::testing {
namespace {

constexpr float albedo = 0.5f;

class GatherPhotons : public RenderTest {
protected:
    GatherPhotons() : random_(5) {}

    float uniform(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random_);
    }

    PhotonRecord photon(glm::vec3 position, bool caustic = false, glm::vec3 normal = {0, 1, 0}) {
        return {position.x,       position.y,
                position.z,       pack_photon_normal(normal, caustic),
                uniform(0.1f, 1), uniform(0.1f, 1),
                uniform(0.1f, 1), pack_unit({0, 1, 0})};
    }

    std::vector<Gathered> gather(const std::vector<PhotonRecord>& photons,
                                 const std::vector<Query>& queries, float radius,
                                 std::uint32_t budget, bool careful = true,
                                 std::uint64_t area_samples = 0, std::uint32_t part = map_whole) {
        const DeviceScene scene =
            upload_scene(device(), floor_scene(lambertian(glm::vec3(albedo)), 1),
                         make_plan({}, {.everything = true}));
        PhotonWorkspace workspace = make_photon_workspace(device(), photons.size());
        const PhotonMap map =
            build_photon_map(device(), scene, workspace, store(device(), workspace, photons),
                             {.area_samples = area_samples});
        RadiusEstimator estimator(device(), scene.plan, {radius, radius}, budget);
        return answers(device(), estimator, map, queries, {.until_complete = careful, .part = part},
                       finished_);
    }

    bool finished_ = true;
    std::mt19937 random_;
};

Gathered expected_sum(const std::vector<PhotonRecord>& photons, const Query& query, double radius) {
    Gathered sum;
    for (const PhotonRecord& p : photons) {
        if (p.normal == no_photon) {
            continue;
        }
        const glm::dvec3 d = glm::dvec3(p.x, p.y, p.z) - glm::dvec3(query.position);
        const double height = glm::dot(d, glm::dvec3(query.normal));
        const double d2 = glm::dot(d, d) - height * height;
        const glm::dvec3 normal(unpack_photon_normal(p.normal));
        const bool same_surface = bend_beyond(query, normal, d) <= 0 &&
                                  glm::dot(normal, glm::dvec3(query.normal)) >= same_surface_cosine;
        if (d2 < radius * radius && same_surface) {
            const double weight = 2 / (double(pi) * radius * radius) *
                                  (1 - d2 / (radius * radius)) * albedo / double(pi);
            (photon_is_caustic(p.normal) ? sum.caustic : sum.indirect) +=
                glm::dvec3(p.flux_r, p.flux_g, p.flux_b) * weight;
        }
    }
    return sum;
}

void expect_near(const Gathered& actual, const Gathered& expected, double tolerance) {
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_RELATIVE(actual.indirect[channel], expected.indirect[channel], tolerance);
        EXPECT_RELATIVE(actual.caustic[channel], expected.caustic[channel], tolerance);
    }
}

TEST_F(GatherPhotons, IsTheKernelsSumOverThoseWithinTheRadius) {
    std::vector<PhotonRecord> photons;
    for (int i = 0; i < 10'000; ++i) {
        photons.push_back(photon({uniform(-1, 1), 0, uniform(-1, 1)}, i % 3 == 0));
    }
    std::vector<Query> queries;
    for (int i = 0; i < 200; ++i) {
        queries.push_back({{uniform(-1, 1), 0, uniform(-1, 1)}});
    }
    for (const float radius : {0.05f, 0.4f, 5.0f}) {
        const std::vector<Gathered> sums = gather(photons, queries, radius, gather_budget, false);
        ASSERT_TRUE(finished_);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            expect_near(sums[i], expected_sum(photons, queries[i], radius), 1e-4);
        }
    }
}

TEST_F(GatherPhotons, PartsOfTheMap) {
    for (const int every : {0, 1, 2, 100}) { // of how many photons one is caustic; 0: none
        for (const int n : {0, 1, 2, 15, 16, 17, 1000}) {
            SCOPED_TRACE(std::to_string(every) + ", " + std::to_string(n));
            std::vector<PhotonRecord> photons;
            std::vector<Query> queries{Query{}};
            for (int i = 0; i < n; ++i) {
                photons.push_back(
                    photon({uniform(-1, 1), 0, uniform(-1, 1)}, every > 0 && i % every == 0));
                queries.push_back({{photons.back().x, 0, photons.back().z}});
            }
            const auto whole = gather(photons, queries, 0.3f, gather_budget);
            // Few iterations per dispatch: queries are interrupted and resumed.
            const auto indirect = gather(photons, queries, 0.3f, 5, true, 0, map_indirect);
            const auto caustic = gather(photons, queries, 0.3f, 5, true, 0, map_caustic);
            for (std::size_t i = 0; i < queries.size(); ++i) {
                ASSERT_EQ(indirect[i].caustic, glm::dvec3(0));
                ASSERT_EQ(caustic[i].indirect, glm::dvec3(0));
                expect_near({indirect[i].indirect, caustic[i].caustic}, whole[i], 1e-6);
            }
        }
    }
}

TEST_F(GatherPhotons, LeavesOutOtherSurfacesAndEmptySlots) {
    const float radius = 0.5f;
    PhotonRecord empty = photon({0, 0, 0});
    empty.normal = no_photon;
    const std::vector<PhotonRecord> photons{
        photon({0.1f, 0, 0}),
        photon({0.1f, 0.45f * flat_tolerance * 0.1f, 0}),
        photon({0.1f, 0.55f * flat_tolerance * 0.1f, 0}),
        photon({0, 0, 0}, false, {0, -1, 0}),
        photon({0, 0, 0}, false, glm::normalize(glm::vec3(1, 0.9f, 0))),
        photon({0.51f, 0, 0}),
        empty,
        photon({0, 0, 0}, false, {1, 0, 0})};
    const Gathered sum = gather(photons, {Query{}}, radius, gather_budget)[0];
    expect_near(sum, expected_sum(photons, Query{}, radius), 1e-5);
    expect_near(sum, expected_sum({photons[0], photons[1], photons[4]}, Query{}, radius), 1e-5);
}

// Of a shell of two layers a millimetre apart, the inner one's photons are at the same side as the
// query. In closed white shells there are many.
TEST_F(GatherPhotons, TellsLayersOfThinShellsApart) {
    std::vector<PhotonRecord> outer, both;
    for (int i = 0; i < 1000; ++i) {
        const float x = uniform(-1, 1), z = uniform(-1, 1);
        outer.push_back(photon({x, 0, z}));
        both.push_back(outer.back());
        both.push_back(photon({x, -0.001f, z}));
    }
    for (const float x : {0.0f, 0.3f, 0.6f}) {
        const std::vector<Query> queries{{{x, 0, 0.2f}}};
        const Gathered one = gather(outer, queries, 0.4f, gather_budget)[0];
        EXPECT_GT(one.indirect.g, 0);
        expect_near(gather(both, queries, 0.4f, gather_budget)[0], one, 1e-5);
    }
}

// Positions of a plane that is far from the origin are rounded by more than the tolerance.
TEST_F(GatherPhotons, KeepsFlatSurfacesFarFromTheOrigin) {
    const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, 1, 0.2f));
    const Frame f = make_frame(normal);
    const glm::vec3 far(1000, 700, -400);
    std::vector<PhotonRecord> photons;
    for (int i = 0; i < 1000; ++i) {
        photons.push_back(photon(far + f.x * uniform(-0.01f, 0.01f) + f.y * uniform(-0.01f, 0.01f),
                                 false, normal));
    }
    double flux = 0;
    for (const PhotonRecord& p : photons) {
        flux += p.flux_g;
    }
    const Gathered sum = gather(photons, {{far, normal}}, 1, gather_budget)[0];
    EXPECT_RELATIVE(sum.indirect.g, flux * 2 / double(pi) * albedo / double(pi), 0.001);
}

// On a sphere of half the disc's radius photons count as far as its normal has turned by 32°.
TEST_F(GatherPhotons, KeepsCurvedSurfaces) {
    const float radius = 0.5f, curvature = 4;
    std::vector<PhotonRecord> photons;
    for (const float angle : {0.1f, 0.3f, 0.54f, 0.58f, 1.0f}) {
        const glm::vec3 normal(std::sin(angle), std::cos(angle), 0);
        photons.push_back(photon((normal - glm::vec3(0, 1, 0)) / curvature, false, normal));
    }
    const Gathered sum = gather(photons, {Query{}}, radius, gather_budget)[0];
    double flux = 0;
    for (const PhotonRecord& p : std::span(photons).first(3)) {
        flux += p.flux_r * (1 - p.x * p.x / (radius * radius));
    }
    EXPECT_RELATIVE(sum.indirect.r, flux * 2 / (double(pi) * radius * radius) * albedo / double(pi),
                    1e-4);
}

// Of no photons, of one, of many in one place, and of light that differs over the disc, with
// centroids that can be written down: even light, light that grows linearly from 0 at the rim, and
// light on half of the disc. At the floor's edge, half of a disc has light, but no more of it is on
// the floor.
TEST_F(GatherPhotons, TellsHowUnevenLightIs) {
    const float radius = 0.3f;
    const auto uneven = [&](const std::vector<PhotonRecord>& photons, glm::vec3 at = glm::vec3(0),
                            std::uint64_t area_samples = 40'000) {
        return gather(photons, {Query{at}}, radius, gather_budget, true, area_samples)[0].uneven;
    };
    const PhotonRecord aside = photon({0.1f, 0, -0.05f});
    EXPECT_EQ(uneven({photon({0.9f, 0, 0})}), 0);
    EXPECT_EQ(uneven({photon({0, 0, 0})}), 0);
    EXPECT_EQ(uneven({aside}, {0, 0, 0}, 0), 0); // without areas nothing is known
    EXPECT_EQ(uneven({aside}), 0);               // by chance
    for (const float extreme : {1e-30f, 1.0f, 1e30f}) {
        PhotonRecord p = aside;
        p.flux_r = p.flux_g = p.flux_b = extreme;
        EXPECT_NEAR(uneven(std::vector<PhotonRecord>(1000, p)), 1, 0.02);
    }
    const auto lit = [&](const auto& irradiance) {
        std::vector<PhotonRecord> photons;
        constexpr int side = 200;
        for (int i = 0; i < side * side; ++i) {
            PhotonRecord p = photon({(2 * static_cast<float>(i % side) + 1) / side - 1, 0,
                                     (2 * static_cast<float>(i / side) + 1) / side - 1});
            p.flux_r = p.flux_g = p.flux_b = irradiance(p.x);
            photons.push_back(p);
        }
        return photons;
    };
    const std::vector<PhotonRecord> even = lit([](float) { return 1.0f; });
    EXPECT_NEAR(uneven(even), 0, 0.003);
    EXPECT_NEAR(uneven(even, {1, 0, 0.2f}), 0, 0.003);
    EXPECT_NEAR(uneven(even, {-1, 0, -1}), 0, 0.003);
    EXPECT_NEAR(uneven(lit([&](float x) { return std::max(1 + x / radius, 0.0f); })), 1 / 12.0,
                0.005);
    const double half = std::pow(16 / (15 * double(pi)), 2) * 3;
    const std::vector<PhotonRecord> one_side = lit([](float x) { return x > 0 ? 1.0f : 0.0f; });
    EXPECT_NEAR(uneven(one_side), half, 0.01);
    EXPECT_NEAR(gather(one_side, {Query{}}, radius, 512, true, 40'000)[0].uneven, uneven(one_side),
                1e-5); // in several dispatches
    EXPECT_GT(half, Untaken::strongly_uneven);
}

// A bright photon among many others may come from behind a wall, unless it is bright because the
// others were aimed. Some photons that are only rare, as those of another light, change little.
TEST_F(GatherPhotons, RarePhotonsMakeLightUnevenByChance) {
    const auto uneven = [&](float bright_flux, std::uint32_t aimed, float from_x, int rare) {
        std::vector<PhotonRecord> photons;
        for (int i = 0; i < 1000; ++i) {
            photons.push_back(photon({uniform(from_x, 0.3f), 0, uniform(-0.3f, 0.3f)}));
            photons.back().direction = pack_photon_direction({0, 1, 0}, 1, i < rare ? 0 : aimed);
        }
        PhotonRecord bright = photon({0.1f, 0, -0.05f});
        bright.flux_r = bright.flux_g = bright.flux_b = bright_flux;
        bright.direction = pack_photon_direction({0, 1, 0}, 1, 0);
        photons.push_back(bright);
        return gather(photons, {Query{}}, 0.3f, gather_budget, true, 40'000)[0].uneven;
    };
    EXPECT_GT(uneven(1000, 0, -0.3f, 0), Untaken::strongly_uneven);
    EXPECT_EQ(uneven(1000, 10, -0.3f, 0), 0);
    const double half = std::pow(16 / (15 * double(pi)), 2) * 3;
    EXPECT_NEAR(uneven(0, 0, 0, 0), half, 0.03);
    EXPECT_GT(uneven(0, 8, 0, 10), Untaken::strongly_uneven);
}

TEST_F(GatherPhotons, FewPhotons) {
    for (const std::size_t n : {0u, 1u, 2u, 7u, 8u, 9u, 17u}) {
        SCOPED_TRACE(n);
        std::vector<PhotonRecord> photons;
        for (std::size_t i = 0; i < n; ++i) {
            photons.push_back(photon({uniform(-0.1f, 0.1f), 0, uniform(-0.1f, 0.1f)}, i % 2 == 0));
        }
        expect_near(gather(photons, {Query{}}, 0.3f, gather_budget)[0],
                    expected_sum(photons, Query{}, 0.3), 1e-5);
    }
}

TEST_F(GatherPhotons, OneAndTwoInOnePointAreTheExactSum) {
    const std::vector<Query> queries{{{0.25f, 0, -0.5f}}, {{0.2f, 0, -0.5f}}, {{-0.9f, 0, 0.9f}}};
    for (const int n : {1, 2}) {
        for (const bool caustic : {false, true}) { // the second one
            std::vector<PhotonRecord> photons;
            for (int i = 0; i < n; ++i) {
                photons.push_back(photon({0.25f, 0, -0.5f}, i == 1 && caustic));
            }
            const std::vector<Gathered> sums = gather(photons, queries, 0.1f, gather_budget);
            for (std::size_t i = 0; i < queries.size(); ++i) {
                SCOPED_TRACE(std::to_string(n) + ", " + std::to_string(i));
                expect_near(sums[i], expected_sum(photons, queries[i], 0.1f), 1e-6);
            }
            EXPECT_GT(sums[1].indirect.g, 0);
        }
    }
}

TEST_F(GatherPhotons, MillionInOnePointIsTheExactSum) {
    std::vector<PhotonRecord> photons;
    for (int i = 0; i < 1'000'000; ++i) {
        photons.push_back(photon({0.25f, 0, -0.5f}, i % 5 == 0));
    }
    const std::vector<Query> queries{{{0.25f, 0, -0.5f}}, {{0.2f, 0, -0.5f}}, {{-0.9f, 0, 0.9f}}};
    const std::vector<Gathered> sums = gather(photons, queries, 0.1f, gather_budget);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        expect_near(sums[i], expected_sum(photons, queries[i], 0.1f), 1e-5);
    }
    EXPECT_GT(sums[1].caustic.g, 0);
    EXPECT_EQ(sums[2].indirect, glm::dvec3(0));
    // One dispatch cannot finish the query: it is counted as unfinished, and adds nothing.
    const Gathered hurried = gather(photons, {queries[0]}, 0.1f, gather_budget, false)[0];
    EXPECT_FALSE(finished_);
    EXPECT_EQ(hurried.indirect, glm::dvec3(0));
}

TEST_F(GatherPhotons, RadiusAsLargeAsTheSceneIsTheExactSum) {
    std::vector<PhotonRecord> photons;
    for (int i = 0; i < 1'000'000; ++i) {
        photons.push_back(photon({uniform(-1, 1), 0, uniform(-1, 1)}, i % 5 == 0));
    }
    const std::vector<Query> queries{{{0, 0, 0}}, {{1, 0, 1}}};
    const std::vector<Gathered> sums = gather(photons, queries, 3, gather_budget);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        expect_near(sums[i], expected_sum(photons, queries[i], 3), 1e-5);
    }
}

TEST_F(GatherPhotons, EdgesOfSurfacesLoseNothing) {
    // Evenly spread photons give the same estimate in the middle, at an edge and in a corner, where
    // half and three quarters of the disc lie off the surface.
    constexpr int side = 200;
    std::vector<PhotonRecord> photons;
    for (int i = 0; i < side * side; ++i) {
        const glm::vec3 p((2.0f * float(i % side) + 1) / side - 1, 0,
                          (2.0f * float(i / side) + 1) / side - 1);
        photons.push_back(photon(p));
        photons.back().flux_r = photons.back().flux_g = photons.back().flux_b =
            4.0f / (side * side);
    }
    const std::vector<Query> queries{{{0, 0, 0}}, {{1, 0, 0.1f}}, {{-0.9f, 0, 0.1f}}, {{1, 0, 1}}};
    const std::vector<Gathered> corrected =
        gather(photons, queries, 0.3f, gather_budget, true, 40'000);
    for (const Gathered& sum : corrected) {
        EXPECT_RELATIVE(sum.indirect.g, albedo / double(pi), 0.03);
    }
    const std::vector<Gathered> plain = gather(photons, queries, 0.3f, gather_budget);
    EXPECT_RELATIVE(plain[1].indirect.g, 0.5 * albedo / double(pi), 0.03);
    EXPECT_RELATIVE(plain[3].indirect.g, 0.25 * albedo / double(pi), 0.03);
}

TEST_F(GatherPhotons, InterruptedQueriesGiveTheSameBits) {
    std::vector<PhotonRecord> photons;
    for (int i = 0; i < 10'000; ++i) {
        photons.push_back(photon({uniform(-1, 1), 0, uniform(-1, 1)}, i % 3 == 0));
    }
    std::vector<Query> queries;
    for (int i = 0; i < 100; ++i) {
        queries.push_back({{uniform(-1, 1), 0, uniform(-1, 1)}});
    }
    const std::vector<Gathered> whole = gather(photons, queries, 0.5f, 60'000);
    for (const std::uint32_t budget : {100u, 1000u, 1001u}) {
        const std::vector<Gathered> parts = gather(photons, queries, 0.5f, budget);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            EXPECT_EQ(parts[i].indirect, whole[i].indirect) << budget;
            EXPECT_EQ(parts[i].caustic, whole[i].caustic) << budget;
        }
    }
}

} // namespace
} // namespace argand::testing
