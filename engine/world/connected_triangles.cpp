#include "world/connected_triangles.hpp"

#include "base/hash_floats.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <utility>

namespace argand {

namespace {

/// The space in which triangles are connected: that of a skin, of a node, or the world.
using Space = std::pair<int, std::int64_t>;
Space space_of(const MovingMesh* mover) {
    return mover == nullptr ? Space{-1, -1}
                            : Space{mover->skin, mover->skin < 0 ? mover->node : -1};
}

} // namespace

std::vector<std::uint32_t> triangles_of(const Scene& scene, const std::vector<bool>& materials) {
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        if (materials[scene.triangle_material[i]]) {
            triangles.push_back(i);
        }
    }
    return triangles;
}

std::vector<const MovingMesh*> movers(const Scene& scene) {
    std::vector<const MovingMesh*> result(scene.triangles.size(), nullptr);
    for (const MovingMesh& mesh : scene.motion.meshes) {
        const auto first = result.begin() + static_cast<std::ptrdiff_t>(mesh.first_triangle);
        std::fill(first, first + static_cast<std::ptrdiff_t>(mesh.triangles), &mesh);
    }
    return result;
}

DisjointSets connected(const Scene& scene, const std::vector<std::uint32_t>& triangles,
                       const std::vector<const MovingMesh*>& mover) {
    using TriangleAt = std::unordered_map<std::array<float, 3>, std::uint32_t, HashFloats>;
    std::map<Space, TriangleAt> spaces;
    DisjointSets sets(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const MovingMesh* mesh = mover[triangles[i]];
        TriangleAt& triangle_at = spaces[space_of(mesh)];
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t vertex = scene.triangles[triangles[i]][k];
            const glm::vec3& p = mesh != nullptr ? mesh->positions[vertex - mesh->first_vertex]
                                                 : scene.positions[vertex];
            sets.join(triangle_at.try_emplace({p.x, p.y, p.z}, i).first->second, i);
        }
    }
    return sets;
}

} // namespace argand
