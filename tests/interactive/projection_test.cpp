#include "interactive/projection.hpp"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace argand {
namespace {

Camera camera() {
    Camera camera;
    camera.position = {0, 0, 2};
    camera.vertical_angle = glm::half_pi<float>();
    return camera;
}

void expect_near(const glm::dvec2& a, const glm::dvec2& b) {
    EXPECT_NEAR(a.x, b.x, 1e-6);
    EXPECT_NEAR(a.y, b.y, 1e-6);
}

TEST(Projection, FindsPointsInThePicture) {
    const Projection projection(camera(), 2);
    expect_near(projection.of({0, 0, 0}).value(), {0.5, 0.5});
    expect_near(projection.of({0, 2, 0}).value(), {0.5, 0}); // its upper edge
    expect_near(projection.of({4, -2, 0}).value(), {1, 1});
    EXPECT_FALSE(projection.of({0, 0, 2}));
    EXPECT_FALSE(projection.of({0, 0, 3}));
}

TEST(Projection, MovesPointsAsThePointerDoes) {
    Camera orthographic = camera();
    orthographic.kind = CameraKind::orthographic;
    orthographic.vertical_extent = 3;
    for (const Camera& seen_by : {camera(), orthographic}) {
        const Projection projection(seen_by, 1.5);
        const glm::dvec3 point(0.3, -0.2, -1);
        const glm::dvec2 before = projection.of(point).value(), by(0.1, -0.05);
        const glm::dvec3 to = point + projection.moved(point, by);
        expect_near(projection.of(to).value(), before + by);
        EXPECT_NEAR(to.z, point.z, 1e-9); // in parallel to the picture
    }
}

} // namespace
} // namespace argand
