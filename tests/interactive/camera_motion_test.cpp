#include "interactive/camera_motion.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace argand {
namespace {

constexpr double quarter = std::numbers::pi / 2;

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_NEAR(glm::length(a - b), 0, 1e-9) << a.x << ' ' << a.y << ' ' << a.z;
}

CameraPlace before_the_origin() { return {.position = {0, 0, 5}, .target = {0, 0, 0}}; }

TEST(CameraMotion, OrbitsAboutItsTarget) {
    const CameraPlace place = before_the_origin();
    expect_near(orbited(place, quarter, 0).position, {5, 0, 0});
    expect_near(orbited(place, 0, quarter / 2).position, glm::dvec3(0, 5, 5) / std::sqrt(2.0));
    expect_near(orbited(place, 0, -quarter / 2).position, glm::dvec3(0, -5, 5) / std::sqrt(2.0));
    for (const double angle : {0.1, 2.0, -7.0}) {
        const CameraPlace moved = orbited(place, angle, angle / 3);
        EXPECT_NEAR(glm::length(moved.position - moved.target), 5, 1e-9);
        expect_near(moved.target, place.target);
    }
}

TEST(CameraMotion, NeverLooksAlongItsUp) {
    for (const double upwards : {3.0, -3.0, 100.0}) {
        for (const CameraPlace& moved :
             {orbited(before_the_origin(), 1, upwards), turned(before_the_origin(), 1, upwards)}) {
            const glm::dvec3 forward = glm::normalize(moved.target - moved.position);
            EXPECT_LT(std::abs(glm::dot(forward, moved.up)), 0.9999);
            EXPECT_GT(std::abs(glm::dot(forward, moved.up)), 0.999);
        }
    }
}

TEST(CameraMotion, TurnsWhereItStands) {
    const CameraPlace place = before_the_origin();
    const CameraPlace moved = turned(place, quarter, 0);
    expect_near(moved.position, place.position);
    expect_near(moved.target, {5, 0, 5}); // to the right
    expect_near(turned(place, 0, quarter / 2).target,
                glm::dvec3(0, 5, -5) / std::sqrt(2.0) + place.position);
}

TEST(CameraMotion, ShiftsAndApproaches) {
    const CameraPlace moved = shifted(before_the_origin(), {1, 2, 3});
    expect_near(moved.position, {1, 2, 2});
    expect_near(moved.target, {1, 2, -3});
    expect_near(approached(before_the_origin(), 0.5).position, {0, 0, 2.5});
}

TEST(CameraMotion, BeginsWhereACameraIs) {
    Camera camera;
    camera.position = {1, 2, 3};
    expect_near(place_of(camera, 4).target, {1, 2, -1});
    expect_near(place_of(camera, 4).up, {0, 1, 0});
    camera.forward = {0, -1, 0};
    camera.up = {0, 0, -1};
    expect_near(place_of(camera, 4).up, {0, 0, -1});
    const nlohmann::json edit = edit_of(place_of(camera, 4));
    EXPECT_EQ(edit["position"], nlohmann::json({1, 2, 3}));
    EXPECT_EQ(edit["target"], nlohmann::json({1, -2, 3}));
}

} // namespace
} // namespace argand
