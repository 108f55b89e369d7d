#pragma once

#include "numbers.hpp"
#include "shared/intersect.h"

#include <array>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace argand::testing {

struct Mesh {
    std::vector<vec3> vertices;
    std::vector<std::array<int, 3>> triangles;
};

/// A closed surface around the origin that is star-shaped from there: an octahedron whose faces are
/// divided into four `cuts` times, with random distances of the vertices from the origin in [1, 1 +
/// bumps].
inline Mesh closed_mesh(int cuts, float bumps, std::mt19937& bits) {
    Mesh mesh;
    mesh.vertices = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2},
                      {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
    for (int cut = 0; cut < cuts; ++cut) {
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b) {
            const auto [at, is_new] =
                middles.insert({{std::min(a, b), std::max(a, b)}, int(mesh.vertices.size())});
            if (is_new) {
                mesh.vertices.push_back(glm::normalize(mesh.vertices[a] + mesh.vertices[b]));
            }
            return at->second;
        };
        std::vector<std::array<int, 3>> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const int ab = middle(a, b);
            const int bc = middle(b, c);
            const int ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.triangles = finer;
    }
    for (vec3& v : mesh.vertices) {
        v *= 1 + bumps * std::uniform_real_distribution<float>()(bits);
    }
    return mesh;
}

inline vec3 any_direction(std::mt19937& bits) {
    std::normal_distribution<double> normal;
    const glm::dvec3 v(normal(bits), normal(bits), normal(bits));
    return rounded(glm::normalize(v));
}

struct TriangleHit {
    bool hit;
    float t, u, v;
};
inline TriangleHit hit_of(const RayShear& shear, vec3 origin, vec3 a, vec3 b, vec3 c,
                          float tmin = 0, float tmax = 3e38f) {
    TriangleHit h{};
    h.hit = intersect_triangle(shear, origin, a, b, c, tmin, tmax, h.t, h.u, h.v);
    return h;
}

} // namespace argand::testing
