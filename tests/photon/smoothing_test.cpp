// The size of footprints that is learnt from the photons around query points.
#include "base/median.hpp"
#include "device_fixture.hpp"
#include "photon/map_queries.hpp"
#include "photon/smoothing.hpp"
#include "shared/footprint.h"
#include "shared/photon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace argand::testing {
namespace {

constexpr float spacing = 0.01f;
constexpr int side = 100;

/// Footprints of smoothing 1 have half-axes |dp|^(1/4) and the same along the normal.
FootprintScale unit_scale() {
    FootprintScale s{};
    s.spacing = s.diffuse = s.caustic = s.flatness = 1;
    s.radius_min = s.caustic_min = 1e-9f;
    s.radius_max = s.caustic_max = 1e9f;
    return s;
}

struct Stored {
    std::vector<PhotonRecord> photons;
    std::vector<glm::uvec4> offsets;

    void add(glm::vec3 position, glm::vec3 normal, bool caustic, glm::vec3 u, glm::vec3 v) {
        PhotonRecord photon{position.x, position.y, position.z, pack_photon_normal(normal, caustic),
                            1,          1,          1,          0};
        const uvec2 a = pack_dual(u);
        const uvec2 b = pack_dual(v);
        photons.push_back(photon);
        offsets.emplace_back(a.x, a.y, b.x, b.y);
    }
};

/// Photons on the plane y = 0, one at random in each cell of this spacing, with differentials of
/// these lengths.
Stored grid(float u, float v) {
    Stored stored;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> jitter;
    for (int i = 0; i < side * side; ++i) {
        const glm::vec3 p((float(i % side) + jitter(random)) * spacing, 0,
                          (float(i / side) + jitter(random)) * spacing);
        stored.add(p, {0, 1, 0}, false, {u, 0, 0}, {0, 0, v});
    }
    return stored;
}

std::vector<glm::vec4> points_in_the_middle() {
    std::vector<glm::vec4> points;
    for (int i = 0; i < 96; ++i) {
        points.emplace_back(0.4f + 0.00213f * float(i), 0, 0.6f - 0.00137f * float(i), 0);
    }
    return points;
}

using Smoothing = RenderTest;

double smoothing_of(Device& device, const Stored& stored, double on_point,
                    const std::vector<glm::vec4>& points = points_in_the_middle()) {
    PhotonWorkspace workspace =
        make_photon_workspace(device, std::max<std::size_t>(stored.photons.size(), 1),
                              {.extents = extents_differentials});
    const StoredPhotons on_device = store(device, workspace, stored.photons, stored.offsets);
    SortedPhotons sorted = sort_photons(device, workspace, on_device);
    add_footprints(device, workspace, unit_scale(), sorted);
    return median_smoothing(device, sorted, points, on_point);
}

TEST_F(Smoothing, AsManyFootprintsOnAPointAsAreAskedFor) {
    for (const float ratio : {1.0f, 16.0f}) {
        const float u = 1e-4f * ratio;
        const float v = 1e-4f;
        const Stored stored = grid(u, v);
        for (const double on_point : {20.0, 100.0, 500.0}) {
            // The ellipse of half-axes s r and s r' has the area of on_point photons.
            const double area = std::numbers::pi * std::pow(u, 0.25) * std::pow(v, 0.25);
            const double expected = std::sqrt(on_point * spacing * spacing / area);
            const double found = smoothing_of(device(), stored, on_point);
            EXPECT_NEAR(found, expected, 0.08 * expected)
                << "ratio " << ratio << ", on point " << on_point;
            // Half of the points lie in that many of these footprints or more.
            std::vector<double> counts;
            for (const glm::vec4& p : points_in_the_middle()) {
                int count = 0;
                for (const PhotonRecord& photon : stored.photons) {
                    const double x = (p.x - photon.x) / (found * std::pow(u, 0.25));
                    const double z = (p.z - photon.z) / (found * std::pow(v, 0.25));
                    count += x * x + z * z <= 1 + 1e-4 ? 1 : 0;
                }
                counts.push_back(count);
            }
            EXPECT_NEAR(median(counts), on_point, 0.16 * on_point)
                << "ratio " << ratio << ", on point " << on_point;
        }
    }
}

TEST_F(Smoothing, CausticsOtherSurfacesAndEmptySlotsDoNotCount) {
    Stored stored = grid(1e-4f, 1e-4f);
    const double plain = smoothing_of(device(), stored, 100);
    for (int i = 0; i < side * side; i += 2) {
        const PhotonRecord p = stored.photons[static_cast<std::size_t>(i)];
        stored.add({p.x, 0, p.z}, {0, 1, 0}, true, {1e-4f, 0, 0}, {0, 0, 1e-4f});
        // A surface a disc's diameter away.
        stored.add({p.x, 0.3f, p.z}, {0, 1, 0}, false, {1e-4f, 0, 0}, {0, 0, 1e-4f});
        stored.add({p.x, 0, p.z}, {0, 1, 0}, false, {1e-4f, 0, 0}, {0, 0, 1e-4f});
        stored.photons.back().normal = no_photon;
    }
    // Which of the photons are looked at changes.
    EXPECT_NEAR(smoothing_of(device(), stored, 100), plain, 0.1 * plain);
}

TEST_F(Smoothing, NothingToLearnFromIsZero) {
    EXPECT_EQ(smoothing_of(device(), {}, 100), 0);
    const Stored stored = grid(1e-4f, 1e-4f);
    EXPECT_EQ(smoothing_of(device(), stored, 100, {}), 0);
    Stored caustic;
    caustic.add({0.5f, 0, 0.5f}, {0, 1, 0}, true, {1e-4f, 0, 0}, {0, 0, 1e-4f});
    EXPECT_EQ(smoothing_of(device(), caustic, 100), 0);
    // More than there are photons: counts as all of them.
    EXPECT_GT(smoothing_of(device(), stored, 1e9), smoothing_of(device(), stored, 5000));
}

} // namespace
} // namespace argand::testing
