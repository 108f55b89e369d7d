#include "photon/triangle_planes.hpp"

#include "accel/kdtree_host.hpp"

#include <algorithm>
#include <array>

namespace argand {

std::vector<CellNode> triangle_planes(const Scene& scene, double cells) {
    const std::size_t triangles = scene.triangles.size();
    if (triangles == 0) {
        return {};
    }
    std::vector<BoxRecord> boxes;
    boxes.reserve(triangles);
    for (const auto& t : scene.triangles) {
        const std::array<glm::vec3, 3> p{scene.positions[t[0]], scene.positions[t[1]],
                                         scene.positions[t[2]]};
        const glm::vec3 low = glm::min(p[0], glm::min(p[1], p[2]));
        const glm::vec3 high = glm::max(p[0], glm::max(p[1], p[2]));
        boxes.push_back({low.x, low.y, low.z, 0, high.x, high.y, high.z, 0});
    }
    const double in_leaf =
        std::clamp(static_cast<double>(triangles) / std::max(cells, 1.0), 1.0, 1e6);
    return planes_of(
        build_kdtree_on_host(boxes, {.leaf_size = static_cast<std::uint32_t>(in_leaf)}).words);
}

} // namespace argand
