#include "rendering.hpp"

#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace testing;

class PhotonsInView : public RenderTest {
protected:
    /// Photons in view over photons stored.
    double share(const Scene& scene, const std::string& method = "photons") {
        // Enough eye paths to look for what is in view all over the picture.
        RenderSettings settings = settings_of(method, 48, 1);
        settings.photons = 20'000;
        const RenderStatistics found = render(scene, settings).statistics;
        EXPECT_GT(found.photons_stored, 1000u);
        return found.photons_in_view / static_cast<double>(found.photons_stored);
    }
};

TEST_F(PhotonsInView, AWallOfACubeHasASixth) {
    Scene scene = box_scene(lambertian(glm::vec3(0.5f)));
    scene.lights = {point_light(glm::vec3(0), glm::vec3(1))};
    scene.cameras = {parallel_rays({0, 0, 0.5f}, {0, 0, -1}, 0.999f)};
    EXPECT_NEAR(share(scene), 1.0 / 6, 0.015);
    EXPECT_NEAR(share(scene, "knn"), 1.0 / 6, 0.015);
    // From a point in the opposite wall, a perspective camera sees the same wall within 53°.
    scene.cameras = {look_at({0, 0, 0.99f}, {0, 0, -1}, 53.3f)};
    EXPECT_NEAR(share(scene), 1.0 / 6, 0.015);
    // A quarter of it.
    scene.cameras = {parallel_rays({0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, -1}, 0.499f)};
    const double quarter = share(scene);
    EXPECT_NEAR(quarter, 1.0 / 24, 0.008);
}

TEST_F(PhotonsInView, PhotonsBehindAWallAreNotInView) {
    Scene scene = box_scene(lambertian(glm::vec3(0.5f)));
    scene.lights = {point_light(glm::vec3(0), glm::vec3(1))};
    // A dim room before the lit one, whose wall hides that.
    add_box(scene, {-1, -1, 1.1f}, {1, 1, 3}, 0, true);
    scene.lights.push_back(point_light({0, 0, 2}, glm::vec3(0.1f)));
    scene.cameras = {look_at({0, 0, 2.9f}, {0, 0, 0}, 90)};
    const double both = share(scene);
    scene.lights.pop_back();
    EXPECT_EQ(share(scene), 0);
    EXPECT_GT(both, 0.1);
}

} // namespace
} // namespace argand
