#include "photon/triangle_planes.hpp"

#include "accel/kdtree_host.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace argand {

std::vector<CellNode> triangle_planes(const Scene& scene, double cells) {
    std::vector<bool> moves(scene.triangles.size(), false);
    for (const MovingMesh& mesh : scene.motion.meshes) {
        std::fill_n(moves.begin() + static_cast<std::ptrdiff_t>(mesh.first_triangle),
                    mesh.triangles, true);
    }
    std::vector<BoxRecord> boxes;
    boxes.reserve(scene.triangles.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        if (moves[i]) {
            continue;
        }
        const auto& t = scene.triangles[i];
        const std::array<glm::vec3, 3> p{scene.positions[t[0]], scene.positions[t[1]],
                                         scene.positions[t[2]]};
        const glm::vec3 low = glm::min(p[0], glm::min(p[1], p[2]));
        const glm::vec3 high = glm::max(p[0], glm::max(p[1], p[2]));
        boxes.push_back({low.x, low.y, low.z, 0, high.x, high.y, high.z, 0});
    }
    if (boxes.empty()) {
        return {};
    }
    const double in_leaf =
        std::clamp(static_cast<double>(boxes.size()) / std::max(cells, 1.0), 1.0, 1e6);
    return planes_of(
        build_kdtree_on_host(boxes, {.leaf_size = static_cast<std::uint32_t>(in_leaf)}).words);
}

} // namespace argand
