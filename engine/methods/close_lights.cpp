#include "methods/close_lights.hpp"

#include "accel/closest_hits.hpp"
#include "base/quantile.hpp"
#include "scene/direction.hpp"
#include "shared/lights.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace argand {

namespace {

// Share of the scattered eye paths that is aimed, for all lights together.
constexpr double aimed_share = 0.25;
// Lights that are examined, those that get most shadow rays, and directions of each.
constexpr std::size_t most_lights = 64;
constexpr int directions = 256;
// A light is close to surfaces if it lights them, on average, as brightly as it would light a
// sphere around it of this radius, divided by the distance of the farthest surfaces.
constexpr double closeness = 1.0 / 16;
// Share of the directions around a light in which nothing is farther than the "farthest" surfaces.
constexpr double farthest_rank = 0.95;
// Greatest distance at which aimed paths pass a light, divided by that of the farthest surfaces.
constexpr double reach = 0.25;

glm::dvec3 direction_around(const LightRecord&, int i) { return spiral_direction(i, directions); }

/// A direction in which the lamp shines.
glm::dvec3 direction_of_light(const LightRecord& lamp, int i) {
    return lamp.kind == light_spot ? to_world(make_frame(light_direction(lamp)),
                                              spiral_direction(i, directions, lamp.cos_outer))
                                   : vec3(direction_around(lamp, i));
}

/// The point and spot lights that get most shadow rays.
std::vector<LightRecord> strongest_lamps(const DeviceScene& scene) {
    const LightTable& table = scene.light_table;
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < table.lights.size(); ++row) {
        const std::uint32_t kind = table.lights[row].kind;
        if (kind == light_point || kind == light_spot) {
            rows.push_back(row);
        }
    }
    const auto share = [&](std::size_t row) { return scene.ray_shares[table.emitter[row]]; };
    std::stable_sort(rows.begin(), rows.end(),
                     [&](std::size_t a, std::size_t b) { return share(a) > share(b); });
    rows.resize(std::min(rows.size(), most_lights));
    std::vector<LightRecord> lamps;
    lamps.reserve(rows.size());
    std::transform(rows.begin(), rows.end(), std::back_inserter(lamps),
                   [&](std::size_t row) { return table.lights[row]; });
    return lamps;
}

/// Distances of what rays from each lamp meet, infinite where they meet nothing. direction: of a
/// lamp's i-th ray.
template <class Direction>
std::vector<double> distances_from(RenderContext& context, const std::vector<LightRecord>& lamps,
                                   const Direction& direction) {
    std::vector<RayRecord> rays;
    rays.reserve(lamps.size() * directions);
    for (const LightRecord& lamp : lamps) {
        for (int i = 0; i < directions; ++i) {
            const glm::vec3 d = direction(lamp, i);
            rays.push_back({lamp.x, lamp.y, lamp.z, far_away, d.x, d.y, d.z, 0});
        }
    }
    std::vector<double> distances;
    distances.reserve(rays.size());
    for (const HitRecord& hit :
         closest_hits(context.device, context.on_device.bvh, context.eye.traversal, rays)) {
        distances.push_back(hit.triangle == no_triangle ? std::numeric_limits<double>::infinity()
                                                        : hit.t);
    }
    return distances;
}

/// A distance that few of the finite ones exceed; 0 if there are none.
double farthest_of(std::span<const double> distances) {
    std::vector<double> finite;
    std::copy_if(distances.begin(), distances.end(), std::back_inserter(finite),
                 [](double distance) { return std::isfinite(distance); });
    if (finite.empty()) {
        return 0;
    }
    return quantile(std::move(finite), farthest_rank);
}

/// Radius of the sphere around a light that it would light as brightly, on average, as what lies in
/// these distances.
double radius_as_bright(std::span<const double> distances) {
    const double sum = std::transform_reduce(distances.begin(), distances.end(), 0.0, std::plus<>(),
                                             [](double d) { return 1 / std::max(d * d, 1e-300); });
    return std::sqrt(static_cast<double>(distances.size()) / sum);
}

/// Those of the lamps that are close to surfaces, the first 32.
std::vector<CloseLight> close_lights(RenderContext& context,
                                     const std::vector<LightRecord>& lamps) {
    const std::vector<double> around = distances_from(context, lamps, direction_around);
    const bool any_spot = std::any_of(lamps.begin(), lamps.end(), [](const LightRecord& lamp) {
        return lamp.kind == light_spot;
    });
    const std::vector<double> lit =
        any_spot ? distances_from(context, lamps, direction_of_light) : around;
    std::vector<CloseLight> found;
    for (std::size_t i = 0; i < lamps.size() && found.size() < most_close_lights; ++i) {
        const double farthest = farthest_of(std::span(around).subspan(i * directions, directions));
        const double close = radius_as_bright(std::span(lit).subspan(i * directions, directions));
        if (close < closeness * farthest) {
            found.push_back({.position = {lamps[i].x, lamps[i].y, lamps[i].z},
                             .close = static_cast<float>(close),
                             .reach = static_cast<float>(reach * farthest)});
        }
    }
    return found;
}

} // namespace

void aim_at_close_lights(RenderContext& context) {
    DeviceScene& scene = context.on_device;
    const Plan& plan = scene.plan;
    std::vector<CloseLight> close;
    const bool aims = plan.needs(Feature::direct_light) && !plan.needs(Feature::light_paths);
    const std::vector<LightRecord> lamps =
        aims && context.settings.bounces > 0 ? strongest_lamps(scene) : std::vector<LightRecord>();
    if (!lamps.empty() && scene.bvh.triangle_count > 0) {
        const StageScope stage(context.device, "learn lights");
        close = close_lights(context, lamps);
    }
    if (!close.empty() || scene.record.close_light_count > 0) {
        set_close_lights(context.device, scene, close, aimed_share);
    }
}

} // namespace argand
