// Degenerate, coincident and grazed triangles, and cameras inside geometry.
#include "extremes.hpp"

namespace argand::testing {
namespace {

/// The room with a second floor of another colour, divided into this many strips from wall to wall.
Scene room_with_floor(int strips) {
    Scene scene = room_scene();
    scene.name = fmt::format("floor of {} strips", strips);
    const double width = 2.0 / strips;
    for (int i = 0; i < strips; ++i) {
        const auto left = static_cast<float>(-1 + width * i);
        const auto right = static_cast<float>(-1 + width * (i + 1));
        add_quad(scene, {left, -0.99f, 1}, {right - left, 0, 0}, {0, 0, -2}, 2);
    }
    return scene;
}

class Slivers : public Extremes {
protected:
    /// Compares the image of a floor that consists of slivers of this aspect with that of a plain
    /// floor, by relMSE.
    void expect_plain_floor(int aspect, double bound) {
        const Scene plain = room_with_floor(1);
        const Scene cut = room_with_floor(aspect);
        Largest worst;
        for (const std::string& method : exact_methods()) {
            const RenderResult expected = sound(plain, small(method, 8));
            const double error = difference(sound(cut, small(method, 8)), expected);
            EXPECT_LT(error, bound) << method;
            worst.take(error, method);
            // Missing slivers would show the other colour.
            EXPECT_GT(difference(sound(room_scene(), small(method, 8)), expected), 3 * bound)
                << method;
        }
        record_extreme(fmt::format("a floor of slivers only, of aspect {}", aspect),
                       fmt::format("the plain floor's picture; relMSE below {}", shown(bound)),
                       worst.text());
    }
};

TEST_F(Slivers, OfAspectTenThousand) { expect_plain_floor(10'000, 0.01); }

TEST_F(Slivers, SlowOfAspectAMillion) { expect_plain_floor(1'000'000, 0.01); }

/// A slanted floor, and another that is rotated within the same plane.
Scene two_floors_in_one_plane(bool first, bool second) {
    Scene scene;
    scene.name = "two floors in one plane";
    const glm::vec3 across = glm::normalize(glm::vec3(1, 0.31f, 0.17f));
    const glm::vec3 up = glm::normalize(glm::cross(glm::vec3(0.2f, 1, 0.1f), across));
    const std::uint32_t dark = add_material(scene, lambertian(glm::vec3(0.2f)));
    const std::uint32_t light = add_material(scene, lambertian(glm::vec3(0.8f)));
    if (first) {
        add_quad(scene, -across - up, 2.0f * across, 2.0f * up, dark);
    }
    if (second) {
        const glm::vec3 a = 0.8f * across + 0.6f * up;
        const glm::vec3 b = -0.6f * across + 0.8f * up;
        add_quad(scene, -a - b, 2.0f * a, 2.0f * b, light);
    }
    const glm::vec3 normal = glm::cross(across, up);
    scene.lights = {point_light(2.0f * normal + 0.3f * across, glm::vec3(3))};
    scene.cameras = {parallel_rays(2.0f * normal + 0.5f * up, {0, 0, 0}, 0.5f)};
    return scene;
}

TEST_F(Extremes, CoplanarTrianglesOfTwoMaterials) {
    Largest worst;
    double most = 0;
    double least = 1;
    for (const std::string& method : exact_methods()) {
        const RenderResult dark = sound(two_floors_in_one_plane(true, false), small(method, 8, 32));
        const RenderResult light =
            sound(two_floors_in_one_plane(false, true), small(method, 8, 32));
        const RenderResult both = sound(two_floors_in_one_plane(true, true), small(method, 8, 32));
        for (std::size_t i = 0; i < layer(both, "").pixels.size(); ++i) {
            const double low = layer(dark, "").pixels[i].g;
            const double high = layer(light, "").pixels[i].g;
            const double found = layer(both, "").pixels[i].g;
            EXPECT_RELATIVE(low * 4, high, 1e-4) << method << ", case " << i;
            const double outside = std::max(low - found, found - high) / high;
            EXPECT_LT(outside, 1e-4) << method << ", case " << i;
            worst.take(std::max(outside, 0.0), method);
            const double share = (found - low) / (high - low);
            most = std::max(most, share);
            least = std::min(least, share);
        }
    }
    record_extreme("two floors in one plane, of albedo 0.2 and 0.8",
                   "each pixel is a mix of the pictures of each alone, within 10^-4: neither "
                   "shadows the other",
                   fmt::format("outside by {}; the lighter one's shares are {} … {}", worst.text(),
                               shown(least), shown(most)));
}

TEST_F(Extremes, EveryTriangleTwiceOrThrice) {
    const Scene once = room_scene();
    for (const int times : {2, 3}) {
        Scene many = once;
        for (int i = 1; i < times; ++i) {
            many.triangles.insert(many.triangles.end(), once.triangles.begin(),
                                  once.triangles.end());
            many.triangle_material.insert(many.triangle_material.end(),
                                          once.triangle_material.begin(),
                                          once.triangle_material.end());
        }
        Largest worst;
        for (const std::string& method : exact_methods()) {
            const double error = difference_of_means(sound(many, small(method, 8)),
                                                     sound(once, small(method, 8)), "indirect");
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
        for (const std::string& method : exact_methods()) {
            const double found =
                radiance(scene, direct(method), {0.3f, height + 1, 0.1f}, {0.1f, height, 0}).g;
            EXPECT_RELATIVE(found, 0.5 / double(pi), 1e-4) << method << ", sine " << sine;
            worst.take(std::abs(found / (0.5 / double(pi)) - 1),
                       fmt::format("{}, {:.0e}", method, sine));
        }
    }
    record_extreme("light that grazes by 10^-3 and 10^-7", "cosine law within 10^-4", worst.text());
}

TEST_F(Extremes, EyesThatGraze) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 1);
    scene.lights = {directional_light({0, -1, 0}, glm::vec3(1))};
    Largest worst;
    for (const float sine : {1e-3f, 1e-5f, 1e-7f}) {
        for (const std::string& method : exact_methods()) {
            // A bundle much narrower than its height above the floor.
            scene.cameras = {parallel_rays({0.5f, 0.5f * sine, 0}, {0, 0, 0}, 1e-4f * sine)};
            const double found = mean(layer(sound(scene, direct(method)), "")).g;
            EXPECT_RELATIVE(found, 0.5 / double(pi), 1e-4) << method << ", sine " << sine;
            worst.take(std::abs(found / (0.5 / double(pi)) - 1),
                       fmt::format("{}, {:.0e}", method, sine));
        }
    }
    record_extreme("eye rays that graze by 10^-3 … 10^-7", "radiance within 10^-4", worst.text());
}

TEST_F(Extremes, EyeInsideAWall) {
    // Inside the room's block, where no light enters, and exactly in the plane of a wall.
    Scene inside = room_scene();
    inside.cameras = {look_at({-0.2f, -0.5f, -0.4f}, {0.1f, 0.2f, 0.95f})};
    Scene within = room_scene();
    within.cameras = {look_at({1, 0.2f, 0.3f}, {0, -0.2f, -1})};
    for (const std::string& method : exact_methods()) {
        EXPECT_EQ(mean(layer(sound(inside, small(method)), "")), glm::dvec3(0)) << method;
        sound(within, small(method));
    }
    record_extreme("eye inside a solid block; in the plane of a wall", "black; finite",
                   "black; finite");
}

} // namespace
} // namespace argand::testing
