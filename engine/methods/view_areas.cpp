#include "methods/view_areas.hpp"

#include "base/median.hpp"
#include "photon/radius.hpp"

#include <cmath>
#include <vector>

namespace argand {

double reach_of_view(std::span<const glm::vec4> queries, const Camera& camera) {
    constexpr double over_median = 4;
    if (queries.empty()) {
        return 0;
    }
    std::vector<double> distances;
    distances.reserve(queries.size());
    for (const glm::vec4& query : queries) {
        distances.push_back(glm::distance(glm::vec3(query), camera.position));
    }
    return over_median * median(std::move(distances));
}

void sample_areas_in_view(RenderContext& context, double reach, double radius, double share) {
    DeviceScene& scene = context.on_device;
    if (!(reach > 0) || std::isfinite(scene.areas.part.reach) ||
        has_room_for_area_samples(scene.surface_area, radius, share)) {
        return;
    }
    const glm::vec3 eye = context.scene.cameras[context.settings.camera].position;
    scene.areas = sample_areas(context.device, scene.photon_surfaces, {eye, reach});
}

} // namespace argand
