// Photons and areas near points in view count only if a ray along the surface reaches one.
#include "device_fixture.hpp"
#include "methods/scenes.hpp"
#include "photon/map_queries.hpp"
#include "photon/photon_map.hpp"
#include "photon/view_points.hpp"
#include "world/world.hpp"

namespace argand::testing {
namespace {

constexpr glm::vec3 up{0, 1, 0};

/// A point in view, on this side of its surface.
ViewPointRecord in_view(glm::vec3 p, glm::vec3 normal = up) {
    return {p.x, p.y, p.z, pack_photon_normal(normal, false), {}};
}

PhotonRecord photon_at(glm::vec3 p, bool caustic = false) {
    return {p.x, p.y, p.z, pack_photon_normal(up, caustic),
            1,   1,   1,   pack_photon_direction(up, 1, 0)};
}

/// Points on a grid over a part of the plane y = 0.
std::vector<glm::vec3> grid(glm::vec2 low, glm::vec2 high, float step) {
    std::vector<glm::vec3> points;
    for (float x = low.x + step / 2; x < high.x; x += step) {
        for (float z = low.y + step / 2; z < high.y; z += step) {
            points.emplace_back(x, 0, z);
        }
    }
    return points;
}

std::vector<ViewPointRecord> all_in_view(const std::vector<glm::vec3>& points) {
    std::vector<ViewPointRecord> result;
    for (const glm::vec3& p : points) {
        result.push_back(in_view(p));
    }
    return result;
}

class ViewLinks : public DeviceTest {
protected:
    static constexpr double radius = 0.3;

    /// The records of a map of these photons and of area samples.
    std::vector<PhotonRecord> records(const Scene& scene, const std::vector<ViewPointRecord>& view,
                                      const std::vector<PhotonRecord>& photons,
                                      std::uint64_t area_samples = 20'000, std::uint64_t slots = 0,
                                      double reach = radius) {
        Device& device = open();
        const DeviceScene on_device =
            upload_scene(device, scene, make_plan(scene, {.everything = true}));
        const ViewPoints points = make_view_points(device, view, reach);
        PhotonWorkspace workspace =
            make_photon_workspace(device, std::max<std::uint64_t>(photons.size(), area_samples));
        workspace.slots = slots > 0 ? slots : workspace.slots;
        const PhotonMap map = build_photon_map(
            device, on_device, workspace, store(device, workspace, photons),
            {.area_samples = area_samples, .drops_covered = true, .view = &points});
        const std::uint32_t stored = download_word(device, map.counters, counter_stored);
        return download<PhotonRecord>(device, map.photons, stored);
    }
};

bool is_area(const PhotonRecord& r) { return (r.normal & area_sample_bit) != 0; }

/// A floor of 4 m by 4 m with a wall over all of z at x from 0 to this thickness.
Scene walled_floor(float thickness, const Material& wall, float height = 1) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 2);
    add_box(scene, {0, -0.01f, -2.1f}, {thickness, height, 2.1f}, add_material(scene, wall), false);
    return scene;
}

const std::vector<glm::vec3> before_wall = grid({-2, -2}, {0, 2}, 0.07f);

// The view has the floor before the wall. Behind it, and inside, only what is farther than the view
// knows of still counts. Batches may be of any size.
TEST_F(ViewLinks, PlacesBehindAWallDoNotCount) {
    std::vector<PhotonRecord> photons;
    for (const glm::vec3& p : grid({-2, -2}, {2, 2}, 0.05f)) {
        photons.push_back(photon_at(p));
    }
    const Scene scene = walled_floor(0.06f, lambertian(glm::vec3(0.5f)));
    for (const std::uint64_t slots : {0u, 1000u, 7u}) {
        SCOPED_TRACE(slots);
        // A thousand batches of seven take long.
        const std::size_t count = slots == 7 ? 100 : photons.size();
        const std::vector<PhotonRecord> some(photons.end() - static_cast<std::ptrdiff_t>(count),
                                             photons.end());
        int before = 0, behind = 0, far = 0;
        for (const PhotonRecord& r :
             records(scene, all_in_view(before_wall), some, slots == 7 ? 100 : 4000, slots)) {
            const bool counts = !is_area(r) || r.flux_r > 0;
            const bool on_floor = std::abs(r.y) < 1e-4f && std::abs(r.z) < 1.9f;
            if (!on_floor || !counts) {
                continue;
            }
            before += r.x < -0.01f ? 1 : 0;
            behind += r.x > 0.01f && r.x < 0.95 * radius ? 1 : 0;
            far += r.x > 2 * radius + 0.2 ? 1 : 0;
        }
        EXPECT_EQ(behind, 0);
        EXPECT_GT(far, 10);
        if (slots != 7) {
            // Of 6,400 photons half, and of 4,000 samples a quarter: there is the wall's area, too.
            EXPECT_GT(before, 4000);
        }
    }
}

TEST_F(ViewLinks, PlacesInViewCount) {
    std::vector<PhotonRecord> photons;
    for (const glm::vec3& p : grid({-2, -1.9f}, {0, 1.9f}, 0.05f)) {
        photons.push_back(photon_at(p));
    }
    std::size_t kept = 0, samples = 0;
    for (const PhotonRecord& r : records(walled_floor(0.06f, lambertian(glm::vec3(0.5f))),
                                         all_in_view(before_wall), photons)) {
        kept += is_area(r) ? 0 : 1;
        if (is_area(r) && std::abs(r.y) < 1e-4f && r.x < -0.01f && std::abs(r.z) < 1.9f) {
            ++samples;
            EXPECT_GT(r.flux_r, 0) << r.x << " " << r.z;
        }
    }
    EXPECT_EQ(kept, photons.size());
    EXPECT_GT(samples, 2000u);
}

TEST_F(ViewLinks, GlassAndLowStepsHideNothing) {
    const PhotonRecord behind = photon_at({0.2f, 0, 0.3f});
    const auto counts = [&](const Scene& scene) {
        int photons = 0;
        for (const PhotonRecord& r : records(scene, all_in_view(before_wall), {behind})) {
            photons += is_area(r) ? 0 : 1;
        }
        return photons == 1;
    };
    EXPECT_FALSE(counts(walled_floor(0.06f, lambertian(glm::vec3(0.5f)))));
    EXPECT_FALSE(counts(walled_floor(0.06f, mirror())));
    EXPECT_TRUE(counts(walled_floor(0.06f, glass(1.5f, false))));
    EXPECT_TRUE(counts(walled_floor(0.06f, lambertian(glm::vec3(0.5f)), 0.01f)));
}

TEST_F(ViewLinks, CausticPhotonsCountEverywhere) {
    int photons = 0;
    for (const PhotonRecord& r :
         records(walled_floor(0.06f, lambertian(glm::vec3(0.5f))), all_in_view(before_wall),
                 {photon_at({0.2f, 0, 0.3f}, true), photon_at({0.2f, 0, 0.3f}, false)})) {
        photons += is_area(r) ? 0 : 1;
    }
    EXPECT_EQ(photons, 1);
}

// Without points, or far from all, nothing tells what is hidden.
TEST_F(ViewLinks, WithoutAPointInViewNearbyEverythingCounts) {
    const Scene scene = walled_floor(0.06f, lambertian(glm::vec3(0.5f)));
    for (const std::vector<ViewPointRecord>& view :
         {std::vector<ViewPointRecord>{}, {in_view({-1.9f, 0, -1.9f})}}) {
        double area = 0;
        for (const PhotonRecord& r : records(scene, view, {photon_at({0.2f, 0, 0.3f})})) {
            area += is_area(r) && std::abs(r.y) < 1e-4f ? r.flux_r : 0;
            EXPECT_TRUE(!is_area(r) || r.flux_r > 0);
        }
        EXPECT_NEAR(area, 16, 0.5);
    }
}

// A single point decides about the places around it, on its side of the surface only.
TEST_F(ViewLinks, PointsSpeakForTheirSideOnly) {
    const Scene scene = walled_floor(0.06f, lambertian(glm::vec3(0.5f)));
    int hidden_above = 0, hidden_below = 0;
    for (const PhotonRecord& r :
         records(scene, {in_view({-0.1f, 0, 0}, up)}, {photon_at({1.5f, 0, 1.5f})}, 4000)) {
        hidden_above += is_area(r) && std::abs(r.y) < 1e-4f && !(r.flux_r > 0) ? 1 : 0;
        hidden_below += is_area(r) && std::abs(r.y) < 1e-4f && !(r.flux_g > 0) ? 1 : 0;
    }
    EXPECT_GT(hidden_above, 5);
    EXPECT_EQ(hidden_below, 0);
}

// A scene a million times as large or small, and one 10 km from the origin, where positions are
// rounded to 1 mm.
TEST_F(ViewLinks, HoldAtTheExtremes) {
    struct Extreme {
        float scale;
        glm::vec3 at;
    };
    for (const Extreme& e :
         {Extreme{1e-6f, {0, 0, 0}}, Extreme{1e6f, {0, 0, 0}}, Extreme{1, {10'000, 0, 0}}}) {
        SCOPED_TRACE(::testing::Message() << e.scale << ", " << e.at.x);
        Scene scene;
        const std::uint32_t white = add_material(scene, lambertian(glm::vec3(0.5f)));
        const auto place = [&](glm::vec3 p) { return e.at + e.scale * p; };
        add_quad(scene, place({-1, 0, 1}), e.scale * glm::vec3{2, 0, 0},
                 e.scale * glm::vec3{0, 0, -2}, white);
        add_quad(scene, place({0, -0.1f, 1.1f}), e.scale * glm::vec3{0, 0, -2.2f},
                 e.scale * glm::vec3{0, 1.1f, 0}, white);
        std::vector<ViewPointRecord> view;
        for (const glm::vec3& p : grid({-1, -1}, {0, 1}, 0.07f)) {
            view.push_back(in_view(place(p)));
        }
        int before = 0, behind = 0;
        for (const PhotonRecord& r : records(scene, view, {photon_at(place({-0.5f, 0, 0}))}, 5000,
                                             0, radius * double(e.scale))) {
            const glm::vec3 p = (glm::vec3(r.x, r.y, r.z) - e.at) / e.scale;
            if (!is_area(r) || unpack_photon_normal(r.normal).y < 0.5f || std::abs(p.z) > 0.9f) {
                continue;
            }
            if (p.x < -0.02f) {
                ++before;
                EXPECT_GT(r.flux_r, 0) << p.x << " " << p.z;
            } else if (p.x > 0.02f && p.x < 0.9 * radius) {
                ++behind;
                EXPECT_EQ(r.flux_r, 0) << p.x << " " << p.z;
            }
        }
        EXPECT_GT(before, 500);
        EXPECT_GT(behind, 100);
    }
}

} // namespace
} // namespace argand::testing
