// The radius that is learnt from the photons around query points, against all distances in double
// precision.
#include "device_fixture.hpp"
#include "methods/bandwidth.hpp"
#include "photon/map_queries.hpp"
#include "photon/radius.hpp"
#include "shared/photon.h"

#include <algorithm>
#include <random>

namespace argand::testing {
namespace {

using Radius = RenderTest;

/// Photons on the walls of the unit cube, each kind evenly but more densely on three of them.
std::vector<PhotonRecord> on_walls(std::size_t number, bool caustic, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit;
    std::vector<PhotonRecord> photons;
    photons.reserve(number);
    for (std::size_t i = 0; i < number; ++i) {
        const int axis = static_cast<int>(random() % 3);
        glm::vec3 p(unit(random), unit(random), unit(random));
        p[axis] = unit(random) < 0.75f ? 0.0f : 1.0f;
        photons.push_back({p.x, p.y, p.z, pack_photon_normal({0, 1, 0}, caustic), 1, 1, 1, 0});
    }
    return photons;
}

std::vector<glm::vec4> places_of(const std::vector<PhotonRecord>& photons) {
    std::vector<glm::vec4> points;
    points.reserve(photons.size());
    for (const PhotonRecord& p : photons) {
        points.emplace_back(p.x, p.y, p.z, 0);
    }
    return points;
}

/// The median distance to the photon of this rank, counted from 0.
double median_distance(const std::vector<PhotonRecord>& photons,
                       const std::vector<glm::vec4>& points, std::size_t rank) {
    std::vector<double> radii;
    for (const glm::vec4& point : points) {
        std::vector<double> distances;
        distances.reserve(photons.size());
        for (const PhotonRecord& p : photons) {
            distances.push_back(
                glm::distance(glm::dvec3(point), glm::dvec3(glm::vec3(p.x, p.y, p.z))));
        }
        const auto nth = distances.begin() + static_cast<std::ptrdiff_t>(rank);
        std::nth_element(distances.begin(), nth, distances.end());
        radii.push_back(*nth);
    }
    std::sort(radii.begin(), radii.end());
    return radii[radii.size() / 2];
}

struct Learnt {
    double radius = 0, caustic = 0;
};

Learnt learn(Device& device, const std::vector<PhotonRecord>& photons,
             const std::vector<glm::vec4>& points, double in_disc) {
    PhotonWorkspace workspace =
        make_photon_workspace(device, std::max<std::size_t>(photons.size(), 1));
    const StoredPhotons stored = store(device, workspace, photons);
    const SortedPhotons sorted = sort_photons(device, workspace, stored);
    return {median_radius(device, sorted, points, in_disc),
            median_caustic_radius(device, sorted, in_disc)};
}

// Photons that lie near a point but far from it in the order are missed: the radius is up to a
// sixth too large, and never too small but by its noise.
TEST_F(Radius, HoldsAsManyPhotonsAsAreWanted) {
    std::vector<PhotonRecord> photons = on_walls(20'000, false, 1);
    const std::vector<PhotonRecord> caustic = on_walls(4'001, true, 2);
    photons.insert(photons.end(), caustic.begin(), caustic.end());
    PhotonRecord empty{};
    empty.normal = no_photon;
    photons.insert(photons.end(), 333, empty);
    std::shuffle(photons.begin(), photons.end(), std::mt19937(3));
    const std::vector<glm::vec4> points = places_of(on_walls(501, false, 4));
    std::vector<PhotonRecord> all;
    std::copy_if(photons.begin(), photons.end(), std::back_inserter(all),
                 [](const PhotonRecord& p) { return p.normal != no_photon; });
    // The last two take samples of the photons.
    for (const std::size_t in_disc : {1, 5, 20, 100, 400}) {
        const Learnt learnt = learn(device(), photons, points, static_cast<double>(in_disc));
        const double radius = median_distance(all, points, in_disc);
        EXPECT_GT(learnt.radius, 0.95 * radius) << in_disc;
        EXPECT_LT(learnt.radius, 1.17 * radius) << in_disc;
        const double of_caustics = median_distance(caustic, places_of(caustic), in_disc);
        EXPECT_GT(learnt.caustic, 0.95 * of_caustics) << in_disc;
        EXPECT_LT(learnt.caustic, 1.17 * of_caustics) << in_disc;
    }
}

TEST_F(Radius, MoreThanThereArePhotonsIsTheFurthest) {
    const std::vector<PhotonRecord> photons = on_walls(7, false, 1);
    const std::vector<glm::vec4> points = places_of(on_walls(9, false, 2));
    EXPECT_NEAR(learn(device(), photons, points, 1e4).radius, median_distance(photons, points, 6),
                2e-3);
}

TEST_F(Radius, NothingToLearnFromIsZero) {
    const std::vector<PhotonRecord> photons = on_walls(100, false, 1);
    EXPECT_EQ(learn(device(), {}, places_of(photons), 4).radius, 0);
    EXPECT_EQ(learn(device(), photons, {}, 4).radius, 0);
    EXPECT_EQ(learn(device(), photons, places_of(photons), 4).caustic, 0);
}

// Where the flux of other photons is uneven, their discs hold more of them. Caustics stay as sharp,
// whether they are so dense that the least radius counts or hardly dense enough to have their own.
TEST_F(Radius, UnevenPhotonsDoNotBlurCaustics) {
    const std::vector<PhotonRecord> others = on_walls(20'000, false, 1);
    const std::vector<glm::vec4> points = places_of(on_walls(501, false, 4));
    for (const float size : {0.03f, 0.25f, 0.45f}) {
        std::vector<PhotonRecord> photons = others;
        for (PhotonRecord p : on_walls(4'000, true, 2)) {
            p.x *= size;
            p.y *= size;
            p.z *= size;
            photons.push_back(p);
        }
        PhotonWorkspace workspace = make_photon_workspace(device(), photons.size());
        const StoredPhotons stored = store(device(), workspace, photons);
        const SortedPhotons sorted = sort_photons(device(), workspace, stored);
        DeviceScene scene;
        scene.record.radius = 1;
        const auto radii = [&](const Evenness& evenness) {
            return learn_radii({.device = device(),
                                .scene = scene,
                                .workspace = workspace,
                                .stored = stored,
                                .photons = sorted,
                                .queries = points,
                                .evenness = evenness},
                               {})
                .radii;
        };
        const GatherRadii even = radii({});
        const GatherRadii uneven = radii({.all = 0.4, .caustics = 1, .others = 0.3});
        EXPECT_GT(uneven.indirect, 1.3 * even.indirect) << size;
        EXPECT_LE(uneven.caustic, even.caustic) << size;
        EXPECT_LT(radii({.all = 0.9, .caustics = 0.3, .others = 1}).indirect, uneven.indirect)
            << size;
    }
}

// A distance of zero, and photons as far away as single precision reaches.
TEST_F(Radius, Extremes) {
    const std::vector<PhotonRecord> one(5,
                                        {1, 2, 3, pack_photon_normal({0, 1, 0}, true), 1, 1, 1, 0});
    EXPECT_LT(learn(device(), one, {{1, 2, 3, 0}}, 2).radius, 1e-35);
    EXPECT_LT(learn(device(), one, {}, 2).caustic, 1e-35);
    for (const float scale : {1e-15f, 1e15f}) {
        std::vector<PhotonRecord> photons = on_walls(5'000, false, 1);
        std::vector<glm::vec4> points = places_of(on_walls(101, false, 2));
        const double expected = learn(device(), photons, points, 50).radius;
        for (PhotonRecord& p : photons) {
            p.x *= scale;
            p.y *= scale;
            p.z *= scale;
        }
        for (glm::vec4& point : points) {
            point *= scale;
        }
        EXPECT_NEAR(learn(device(), photons, points, 50).radius / scale, expected, 0.01 * expected);
    }
}

} // namespace
} // namespace argand::testing
