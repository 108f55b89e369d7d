#include "gltf_builder.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace testing_gltf;

GltfBuilder with_camera(const json& camera, json node = json::object()) {
    GltfBuilder builder = one_triangle();
    builder.root["cameras"] = nlohmann::json::array({camera});
    node["camera"] = 0;
    builder.add_node(node);
    return builder;
}

json perspective(double angle) {
    return {{"type", "perspective"},
            {"perspective", {{"yfov", angle}, {"znear", 0.1}, {"aspectRatio", 1.5}}}};
}

json orthographic(double x, double y) {
    return {{"type", "orthographic"},
            {"orthographic", {{"xmag", x}, {"ymag", y}, {"znear", 0}, {"zfar", 9}}}};
}

TEST(GltfCamera, ReadsPerspectiveCameras) {
    json camera = perspective(0.5);
    camera["name"] = "main";
    const Scene scene = with_camera(camera, {{"translation", {1, 2, 3}}}).load();
    ASSERT_EQ(scene.cameras.size(), 1u);
    const Camera& read = scene.cameras[0];
    EXPECT_EQ(read.name, "main");
    EXPECT_EQ(read.kind, CameraKind::perspective);
    EXPECT_EQ(read.position, glm::vec3(1, 2, 3));
    EXPECT_EQ(read.forward, glm::vec3(0, 0, -1));
    EXPECT_EQ(read.up, glm::vec3(0, 1, 0));
    EXPECT_EQ(read.right, glm::vec3(1, 0, 0));
    EXPECT_FLOAT_EQ(read.vertical_angle, 0.5f);
    EXPECT_FLOAT_EQ(read.aspect, 1.5f);
    EXPECT_FALSE(has_note(scene, "no camera"));
}

TEST(GltfCamera, ReadsOrthographicCameras) {
    const Camera camera =
        with_camera(orthographic(3, -2), {{"name", "carrier"}}).load().cameras.at(0);
    EXPECT_EQ(camera.kind, CameraKind::orthographic);
    EXPECT_EQ(camera.name, "carrier");
    EXPECT_FLOAT_EQ(camera.vertical_extent, 2);
    EXPECT_FLOAT_EQ(camera.aspect, 1.5f);
}

TEST(GltfCamera, StaysOrthonormalUnderScaleAndShear) {
    const Camera camera =
        with_camera(perspective(1), {{"matrix", {2, 0, 0, 0, 3, 5, 0, 0, 1, 1, -7, 0, 0, 0, 0, 1}}})
            .load()
            .cameras.at(0);
    expect_near(camera.forward, glm::normalize(glm::dvec3(-1, -1, 7)));
    EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0, 1e-6);
    EXPECT_NEAR(glm::dot(camera.forward, camera.right), 0, 1e-6);
    EXPECT_NEAR(glm::dot(camera.right, camera.up), 0, 1e-6);
    expect_near(glm::cross(camera.right, camera.up), -camera.forward);
    EXPECT_GT(glm::dot(camera.up, glm::vec3(3, 5, 0)), 0);
}

TEST(GltfCamera, RejectsInvalidCameras) {
    using ::testing::HasSubstr;
    for (const double angle : {0.0, -1.0, 3.2}) {
        EXPECT_THAT(with_camera(perspective(angle)).problem(),
                    HasSubstr("camera 0 has an angle of view"));
    }
    EXPECT_THAT(with_camera(orthographic(0, 1)).problem(), HasSubstr("both must be positive"));
    json camera = perspective(1);
    camera["perspective"]["aspectRatio"] = -1;
    EXPECT_THAT(with_camera(camera).problem(), HasSubstr("aspect ratio"));
    EXPECT_THAT(with_camera(perspective(1), {{"translation", {0, 1e300, 0}}}).problem(),
                HasSubstr("not finite"));
    GltfBuilder builder = with_camera(perspective(1));
    builder.root["nodes"][1]["camera"] = 3;
    EXPECT_THAT(builder.problem(), HasSubstr("camera 3, which does not exist"));
}

TEST(GltfCamera, LeavesOutCamerasWithoutADirection) {
    const Scene scene = with_camera(perspective(1), {{"scale", {0, 0, 0}}}).load();
    EXPECT_TRUE(has_note(scene, "camera 0 is left out"));
    EXPECT_TRUE(has_note(scene, "there is no camera"));
    EXPECT_EQ(scene.cameras.size(), 1u);
}

// Image coordinates of a point: inside the image if within ±1, in front of the camera if depth > 0.
glm::dvec3 project(const Camera& camera, const glm::dvec3& point) {
    const glm::dvec3 offset = point - glm::dvec3(camera.position);
    const double depth = glm::dot(offset, glm::dvec3(camera.forward));
    const double slope = std::tan(camera.vertical_angle / 2);
    return {glm::dot(offset, glm::dvec3(camera.right)) / (depth * slope),
            glm::dot(offset, glm::dvec3(camera.up)) / (depth * slope), depth};
}

TEST(FramingCamera, SeesTheWholeScene) {
    const std::vector<std::vector<glm::vec3>> scenes{
        right_triangle(),
        {{1000, 0, 0}, {1001, 0, 0}, {1000, 500, 3}},
        {{0, 0, -1e6f}, {1, 0, 1e6f}, {0, 1, 0}},
        {{1e-10f, 0, 0}, {2e-10f, 0, 0}, {0, 1e-10f, 0}},
    };
    for (const std::vector<glm::vec3>& corners : scenes) {
        GltfBuilder builder;
        builder.add_triangles(corners);
        const Scene scene = builder.load();
        EXPECT_TRUE(has_note(scene, "no camera: one that sees"));
        ASSERT_EQ(scene.cameras.size(), 1u);
        const Camera& camera = scene.cameras[0];
        EXPECT_FLOAT_EQ(camera.vertical_angle, 0.7853982f);
        EXPECT_LT(camera.forward.z, 0); // from the front
        EXPECT_LT(camera.forward.y, 0); // from above
        double largest = 0;
        for (const glm::vec3& corner : corners) {
            const glm::dvec3 seen = project(camera, corner);
            EXPECT_GT(seen.z, 0);
            largest = std::max({largest, std::abs(seen.x), std::abs(seen.y)});
        }
        EXPECT_LT(largest, 1);
        EXPECT_GT(largest, 0.2); // and is not too far away
    }
}

} // namespace
} // namespace argand
