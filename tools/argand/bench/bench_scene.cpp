#include "bench_scene.hpp"

#include <cmath>
#include <limits>

namespace argand {

namespace {

constexpr float room = 5; // half the edge

void add_grid(BenchScene& scene, std::uint32_t rows, std::uint32_t columns, auto&& point) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t column = 0; column <= columns; ++column) {
            scene.positions.emplace_back(point(double(row) / rows, double(column) / columns), 1);
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t a = first + row * (columns + 1) + column;
            const std::uint32_t b = a + columns + 1;
            scene.triangles.emplace_back(a, b, a + 1, 0);
            scene.triangles.emplace_back(a + 1, b, b + 1, 0);
        }
    }
}

void add_wall(BenchScene& scene, std::uint32_t detail, int axis, float side) {
    add_grid(scene, detail, detail, [&](double u, double v) {
        glm::vec3 point;
        point[axis] = side;
        point[(axis + 1) % 3] = room * float(2 * u - 1);
        point[(axis + 2) % 3] = room * float(2 * v - 1);
        return point;
    });
}

void add_bumpy_sphere(BenchScene& scene, std::uint32_t detail, glm::vec3 centre, double radius) {
    add_grid(scene, 2 * detail, 4 * detail, [&](double u, double v) {
        const double theta = M_PI * u;
        const double phi = 2 * M_PI * v;
        const double r =
            radius * (1 + 0.1 * std::sin(9 * theta) * std::sin(theta) * std::cos(8 * phi));
        return centre + glm::vec3(r * std::sin(theta) * std::cos(phi), r * std::cos(theta),
                                  r * std::sin(theta) * std::sin(phi));
    });
}

} // namespace

BenchScene make_bench_scene(std::uint32_t detail) {
    BenchScene scene;
    scene.eye = {-4.2f, 0.8f, -4.5f};
    scene.target = {0.5f, -0.8f, 0.5f};
    scene.light = {0.5f, 4.5f, 0};
    for (int axis = 0; axis < 3; ++axis) {
        add_wall(scene, detail, axis, -room);
        add_wall(scene, detail, axis, room);
    }
    for (int i = 0; i < 19; ++i) {
        // A spiral that fills the room, with larger spheres below.
        const double angle = 2.4 * i;
        const double distance = 0.95 * std::sqrt(i + 0.3);
        const double height = -3.6 + 0.38 * i;
        add_bumpy_sphere(scene, detail,
                         glm::vec3(distance * std::cos(angle), height, distance * std::sin(angle)),
                         1.1 - 0.03 * i);
    }
    return scene;
}

BenchRays primary_rays(const BenchScene& scene, std::uint32_t edge) {
    const glm::vec3 forward = glm::normalize(scene.target - scene.eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0)));
    const glm::vec3 up = glm::cross(right, forward);
    const float scale = std::tan(0.6f);
    BenchRays rays;
    constexpr std::uint32_t width = 8;
    constexpr std::uint32_t height = 4;
    for (std::uint32_t y = 0; y < edge; y += height) {
        for (std::uint32_t x = 0; x < edge; x += width) {
            for (std::uint32_t i = 0; i < width * height; ++i) {
                const float u = (2 * (float(x + i % width) + 0.5f) / float(edge) - 1) * scale;
                const float v = (1 - 2 * (float(y + i / width) + 0.5f) / float(edge)) * scale;
                rays.origins.push_back(scene.eye);
                rays.directions.push_back(glm::normalize(forward + u * right + v * up));
                rays.ends.push_back(1.0e30f);
            }
        }
    }
    return rays;
}

} // namespace argand
