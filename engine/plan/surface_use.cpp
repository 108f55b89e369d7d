#include "plan/surface_use.hpp"

#include "scene/solids.hpp"

#include <algorithm>

namespace argand {

namespace {

/// For each vertex whether it has a normal: those of moving meshes, at some moment.
std::vector<bool> vertices_with_normals(const Scene& scene) {
    const auto is_normal = [](const glm::vec3& normal) { return normal != glm::vec3(0); };
    std::vector<bool> result(scene.normals.size());
    std::transform(scene.normals.begin(), scene.normals.end(), result.begin(), is_normal);
    for (const MovingMesh& mesh : scene.motion.meshes) {
        for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
            result[mesh.first_vertex + v] =
                is_normal(mesh.normals[v]) ||
                std::any_of(mesh.targets.begin(), mesh.targets.end(), [&](const MorphTarget& t) {
                    return !t.normals.empty() && is_normal(t.normals[v]);
                });
        }
    }
    return result;
}

} // namespace

SurfaceUse surface_use(const Scene& scene) {
    SurfaceUse use;
    use.triangles.resize(scene.materials.size(), 0);
    const std::vector<bool> has_normal = vertices_with_normals(scene);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const std::uint32_t material = scene.triangle_material[i];
        if (use.triangles[material]++ == 0) {
            use.materials.push_back(material);
        }
        const glm::uvec3& corners = scene.triangles[i];
        if (!use.smoothed &&
            (has_normal[corners.x] || has_normal[corners.y] || has_normal[corners.z])) {
            use.smoothed = material;
        }
    }
    use.solids = known_solid_ranks(scene);
    return use;
}

} // namespace argand
