#pragma once

#include "device/device.hpp"
#include "shared/geometry_records.h"

#include <cmath>
#include <glm/glm.hpp>
#include <random>
#include <vector>

namespace argand {

/// Triangles as build_triangle_bvh takes them.
struct Mesh {
    std::vector<glm::vec4> positions;
    std::vector<glm::uvec4> triangles;

    void add(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        positions.insert(positions.end(), {glm::vec4(a, 1), glm::vec4(b, 1), glm::vec4(c, 1)});
        triangles.emplace_back(first, first + 1, first + 2, 0);
    }
    glm::vec3 corner(std::size_t triangle, int which) const {
        return glm::vec3(positions[triangles[triangle][which]]);
    }
};

inline glm::vec3 random_point(std::mt19937& random, float size = 1) {
    std::uniform_real_distribution<float> uniform(-size, size);
    const float x = uniform(random);
    const float y = uniform(random);
    return {x, y, uniform(random)};
}

inline glm::vec3 random_direction(std::mt19937& random) {
    for (;;) {
        const glm::vec3 point = random_point(random);
        const float length = glm::length(point);
        if (length > 0.1f && length <= 1) {
            return point / length;
        }
    }
}

/// Separate triangles of a given size in a cube of half edge 1.
inline Mesh random_triangles(std::size_t count, float size, std::uint32_t seed) {
    std::mt19937 random(seed);
    Mesh mesh;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 centre = random_point(random);
        const glm::vec3 a = centre + random_point(random, size);
        const glm::vec3 b = centre + random_point(random, size);
        mesh.add(a, b, centre + random_point(random, size));
    }
    return mesh;
}

/// A closed, bumpy sphere with shared vertices: `rings` rows of 2 `rings` quadrilaterals, triangles
/// at the poles.
inline Mesh bumpy_sphere(std::uint32_t rings, float bump) {
    const std::uint32_t sectors = 2 * rings;
    Mesh mesh;
    mesh.positions.emplace_back(0, 0, 1, 1);
    for (std::uint32_t ring = 1; ring < rings; ++ring) {
        for (std::uint32_t sector = 0; sector < sectors; ++sector) {
            const double theta = M_PI * ring / rings;
            const double phi = 2 * M_PI * sector / sectors;
            const double radius = 1 + bump * std::sin(7 * theta) * std::cos(5 * phi);
            mesh.positions.emplace_back(radius * std::sin(theta) * std::cos(phi),
                                        radius * std::sin(theta) * std::sin(phi),
                                        radius * std::cos(theta), 1);
        }
    }
    mesh.positions.emplace_back(0, 0, -1, 1);
    const auto vertex = [&](std::uint32_t ring, std::uint32_t sector) {
        return ring == 0       ? 0u
               : ring == rings ? static_cast<std::uint32_t>(mesh.positions.size() - 1)
                               : 1 + (ring - 1) * sectors + sector % sectors;
    };
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        for (std::uint32_t sector = 0; sector < sectors; ++sector) {
            if (ring > 0) {
                mesh.triangles.emplace_back(vertex(ring, sector), vertex(ring + 1, sector),
                                            vertex(ring, sector + 1), 0);
            }
            if (ring + 1 < rings) {
                mesh.triangles.emplace_back(vertex(ring, sector + 1), vertex(ring + 1, sector),
                                            vertex(ring + 1, sector + 1), 0);
            }
        }
    }
    return mesh;
}

inline RayRecord make_ray(glm::vec3 origin, glm::vec3 direction, float t_max = INFINITY) {
    return {origin.x, origin.y, origin.z, t_max, direction.x, direction.y, direction.z, 0};
}

inline std::vector<RayRecord> random_rays(std::size_t count, float size, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<RayRecord> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 origin = random_point(random, size);
        rays.push_back(make_ray(origin, random_direction(random)));
    }
    return rays;
}

} // namespace argand
