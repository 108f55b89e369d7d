// Triangles that are next to nothing, in one another's place, or grazed; eyes where none should be.
#include "extremes.hpp"

namespace argand::testing {
namespace {

TEST_F(Extremes, SliversOfAspectAMillion) {
    // The room's floor again, cut by slivers from wall to wall.
    Scene plain = room_scene();
    add_floor(plain, 1, -0.99f, 2);
    Scene cut = room_scene();
    const int strips = 20;
    const float width = 2e-6f;
    for (int i = 0; i < strips; ++i) {
        const float left = -1 + 2 * static_cast<float>(i) / strips + (i > 0 ? width : 0);
        const float right = -1 + 2 * static_cast<float>(i + 1) / strips;
        add_quad(cut, {left, -0.99f, 1}, {right - left, 0, 0}, {0, 0, -2}, 2);
        add_quad(cut, {right, -0.99f, 1}, {width, 0, 0}, {0, 0, -2}, 2);
    }
    Largest worst;
    for (const std::string& method : method_names()) {
        const double error =
            difference_of_means(sound(cut, small(method, 8)), sound(plain, small(method, 8)));
        EXPECT_LT(error, 0.02) << method;
        worst.take(error, method);
    }
    record_extreme("slivers of aspect 10^6", "the same picture as without the cuts; mean within 2 %",
                   worst.text());
}

TEST_F(Extremes, EveryTriangleTwiceOrThrice) {
    const Scene once = room_scene();
    for (const int times : {2, 3}) {
        Scene many = once;
        for (int i = 1; i < times; ++i) {
            many.triangles.insert(many.triangles.end(), once.triangles.begin(), once.triangles.end());
            many.triangle_material.insert(many.triangle_material.end(), once.triangle_material.begin(),
                                          once.triangle_material.end());
        }
        Largest worst;
        for (const std::string& method : method_names()) {
            const double error =
                difference_of_means(sound(many, small(method, 8)), sound(once, small(method, 8)), "indirect");
            EXPECT_LT(error, 0.02) << method;
            worst.take(error, method);
        }
        record_extreme(fmt::format("every triangle {} times", times),
                       "the same picture; mean of the indirect layer within 2 %", worst.text());
    }
}

RenderSettings direct(const std::string& method) {
    RenderSettings settings = settings_of(method, 4, 4);
    settings.bounces = 0;
    return settings;
}

TEST_F(Extremes, SunsThatGraze) {
    const Scene floor = floor_scene(lambertian(glm::vec3(0.5f)), 1);
    Largest worst;
    for (const float sine : {1e-3f, 1e-7f}) {
        const float height = 0.3f;
        Scene scene = floor;
        for (glm::vec3& p : scene.positions) {
            p.y += height;
        }
        scene.lights = {directional_light({1, -sine, 0}, glm::vec3(1 / sine))};
        for (const std::string& method : method_names()) {
            const double found =
                radiance(scene, direct(method), {0.3f, height + 1, 0.1f}, {0.1f, height, 0}).g;
            EXPECT_RELATIVE(found, 0.5 / double(pi), 1e-4) << method << ", " << sine;
            worst.take(std::abs(found / (0.5 / double(pi)) - 1), fmt::format("{}, {:.0e}", method, sine));
        }
    }
    record_extreme("light that grazes by 10^-3 and 10^-7", "cosine law within 10^-4", worst.text());
}

TEST_F(Extremes, EyesThatGraze) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 1);
    scene.lights = {directional_light({0, -1, 0}, glm::vec3(1))};
    Largest worst;
    for (const float sine : {1e-3f, 1e-5f, 1e-7f}) {
        for (const std::string& method : method_names()) {
            // A bundle far narrower than it is high above the floor.
            scene.cameras = {parallel_rays({0.5f, 0.5f * sine, 0}, {0, 0, 0}, 1e-4f * sine)};
            const double found = mean(layer(sound(scene, direct(method)), "")).g;
            EXPECT_RELATIVE(found, 0.5 / double(pi), 1e-4) << method << ", " << sine;
            worst.take(std::abs(found / (0.5 / double(pi)) - 1), fmt::format("{}, {:.0e}", method, sine));
        }
    }
    record_extreme("eye rays that graze by 10^-3 … 10^-7", "radiance within 10^-4", worst.text());
}

TEST_F(Extremes, EyeInsideAWall) {
    // Between the faces of the room's block, which no light enters; and exactly in the plane of a wall.
    Scene inside = room_scene();
    inside.cameras = {look_at({-0.2f, -0.5f, -0.4f}, {0.1f, 0.2f, 0.95f})};
    Scene within = room_scene();
    within.cameras = {look_at({1, 0.2f, 0.3f}, {0, -0.2f, -1})};
    for (const std::string& method : method_names()) {
        EXPECT_EQ(mean(layer(sound(inside, small(method)), "")), glm::dvec3(0)) << method;
        sound(within, small(method));
    }
    record_extreme("eye inside a solid block; in the plane of a wall", "black; finite", "black; finite");
}

} // namespace
} // namespace argand::testing
