#include "methods/view_areas.hpp"

#include "base/median.hpp"
#include "photon/radius.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace argand {

namespace {

/// A ball that holds the points, and a little more: others in view lie between them.
SampledPart ball_around(std::span<const glm::vec4> points) {
    constexpr double over_farthest = 1.25;
    glm::vec3 low(points[0]), high(points[0]);
    for (const glm::vec4& point : points) {
        low = glm::min(low, glm::vec3(point));
        high = glm::max(high, glm::vec3(point));
    }
    SampledPart ball{.center = low + 0.5f * (high - low), .reach = 0};
    for (const glm::vec4& point : points) {
        const double distance = glm::distance(glm::dvec3(point), glm::dvec3(ball.center));
        ball.reach = std::max(ball.reach, over_farthest * distance);
    }
    return ball;
}

} // namespace

ViewParts parts_of_view(std::span<const glm::vec4> queries, const Camera& camera) {
    constexpr double over_median = 4;
    if (queries.empty()) {
        return {};
    }
    std::vector<double> distances;
    distances.reserve(queries.size());
    for (const glm::vec4& query : queries) {
        distances.push_back(glm::distance(glm::vec3(query), camera.position));
    }
    return {.around_eye = {camera.position, over_median * median(std::move(distances))},
            .around_points = ball_around(queries)};
}

void persist_view(Archive& archive, ViewParts& view) {
    for (SampledPart* part : {&view.around_eye, &view.around_points}) {
        archive.value(part->center);
        archive.value(part->reach);
    }
}

void sample_areas_in_view(RenderContext& context, const ViewParts& view, double radius,
                          double share) {
    DeviceScene& scene = context.on_device;
    const auto sample = [&](const SampledPart& part) {
        scene.areas = sample_areas(context.device, scene.photon_surfaces, part);
    };
    if (!(view.around_eye.reach > 0)) {
        return;
    }
    if (!std::isfinite(scene.areas.part.reach)) {
        if (has_room_for_area_samples(scene.surface_area, radius, share)) {
            return;
        }
        sample(view.around_eye);
    }
    if (view.around_points.reach > 0 && view.around_points.reach < scene.areas.part.reach &&
        area_samples(scene.areas.area, radius, share) == 0) {
        sample(view.around_points);
    }
}

} // namespace argand
