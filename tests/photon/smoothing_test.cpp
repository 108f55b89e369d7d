// The size of footprints that is learnt from the photons around query points.
#include "photon/smoothing.hpp"

#include "shared/footprint.h"
#include "shared/photon.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace argand {
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

/// Photons on the plane y = 0, `spacing` apart, with differentials of these lengths.
Stored grid(float u, float v) {
    Stored stored;
    for (int i = 0; i < side * side; ++i) {
        const glm::vec3 p(float(i % side) * spacing, 0, float(i / side) * spacing);
        stored.add(p, {0, 1, 0}, false, {u, 0, 0}, {0, 0, v});
    }
    return stored;
}

std::vector<glm::vec3> points_in_the_middle() {
    std::vector<glm::vec3> points;
    for (int i = 0; i < 96; ++i) {
        points.emplace_back(0.4f + 0.00213f * float(i), 0, 0.6f - 0.00137f * float(i));
    }
    return points;
}

double smoothing_of(const Stored& stored, double on_point) {
    return median_smoothing(stored.photons, stored.offsets, points_in_the_middle(), unit_scale(),
                            on_point);
}

TEST(Smoothing, AsManyFootprintsOnAPointAsAreAskedFor) {
    for (const float ratio : {1.0f, 16.0f}) {
        const float u = 1e-4f * ratio;
        const float v = 1e-4f;
        const Stored stored = grid(u, v);
        for (const double on_point : {20.0, 100.0, 500.0}) {
            // The ellipse of half-axes s r and s r' has the area of on_point photons.
            const double area = std::numbers::pi * std::pow(u, 0.25) * std::pow(v, 0.25);
            const double expected = std::sqrt(on_point * spacing * spacing / area);
            const double found = smoothing_of(stored, on_point);
            EXPECT_NEAR(found, expected, 0.06 * expected)
                << "ratio " << ratio << ", on point " << on_point;
            // Half of the points lie in that many of these footprints.
            std::vector<int> counts;
            for (const glm::vec3& p : points_in_the_middle()) {
                int count = 0;
                for (const PhotonRecord& photon : stored.photons) {
                    const double x = (p.x - photon.x) / (found * std::pow(u, 0.25));
                    const double z = (p.z - photon.z) / (found * std::pow(v, 0.25));
                    count += x * x + z * z <= 1 + 1e-4 ? 1 : 0;
                }
                counts.push_back(count);
            }
            const auto enough =
                std::count_if(counts.begin(), counts.end(), [&](int n) { return n >= on_point; });
            EXPECT_NEAR(static_cast<double>(enough), 48, 8)
                << "ratio " << ratio << ", on point " << on_point;
        }
    }
}

TEST(Smoothing, CausticsOtherSurfacesAndEmptySlotsDoNotCount) {
    Stored stored = grid(1e-4f, 1e-4f);
    const double plain = smoothing_of(stored, 100);
    for (int i = 0; i < side * side; i += 2) {
        const PhotonRecord p = stored.photons[static_cast<std::size_t>(i)];
        stored.add({p.x, 0, p.z}, {0, 1, 0}, true, {1e-4f, 0, 0}, {0, 0, 1e-4f});
        // A surface a disc's diameter away.
        stored.add({p.x, 0.3f, p.z}, {0, 1, 0}, false, {1e-4f, 0, 0}, {0, 0, 1e-4f});
        stored.add({p.x, 0, p.z}, {0, 1, 0}, false, {1e-4f, 0, 0}, {0, 0, 1e-4f});
        stored.photons.back().normal = no_photon;
    }
    EXPECT_EQ(smoothing_of(stored, 100), plain);
}

TEST(Smoothing, NothingToLearnFromIsZero) {
    EXPECT_EQ(smoothing_of({}, 100), 0);
    const Stored stored = grid(1e-4f, 1e-4f);
    EXPECT_EQ(median_smoothing(stored.photons, stored.offsets, {}, unit_scale(), 100), 0);
    Stored caustic;
    caustic.add({0.5f, 0, 0.5f}, {0, 1, 0}, true, {1e-4f, 0, 0}, {0, 0, 1e-4f});
    EXPECT_EQ(smoothing_of(caustic, 100), 0);
    // More than there are photons: counts as all of them.
    EXPECT_GT(smoothing_of(stored, 1e9), smoothing_of(stored, 5000));
}

} // namespace
} // namespace argand
