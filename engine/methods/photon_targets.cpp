#include "methods/photon_targets.hpp"

#include "base/quantile.hpp"
#include "methods/view_extent.hpp"
#include "shared/lights.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace argand {

namespace {

// Share of the photons that is aimed, at all targets together.
constexpr double aimed_share = 0.1;
// A caster that more of the photons hit anyway is no target.
constexpr double most_natural_share = 0.005;
// Targets lie within this distance from the middle of what is in view, over its extent.
constexpr double reach = 4;
// Casters, the nearest ones, of which the natural share is computed.
constexpr std::size_t most_candidates = 64;

/// The point that stands for a light inside the scene: its own, or the middle of its triangle.
glm::dvec3 middle_of(const LightRecord& light) {
    const glm::dvec3 first(light.x, light.y, light.z);
    if (light.kind != light_triangle) {
        return first;
    }
    return (first + glm::dvec3(light.dx, light.dy, light.dz) +
            glm::dvec3(light.ex, light.ey, light.ez)) /
           3.0;
}

bool is_inside(const LightRecord& light) { return !is_from_outside(light); }

/// About the share of the photons from lights inside the scene that hits this sphere if none are
/// aimed.
double natural_share(const LightTable& table, const glm::vec4& sphere) {
    double hits = 0;
    double all = 0;
    for (std::size_t i = 0; i < table.lights.size(); ++i) {
        if (!is_inside(table.lights[i])) {
            continue;
        }
        const glm::dvec3 to = glm::dvec3(sphere) - middle_of(table.lights[i]);
        const double sine2 = double(sphere.w) * sphere.w / std::max(glm::dot(to, to), 1e-300);
        hits += table.weights[i] * std::min(sine2 / 4, 1.0);
        all += table.weights[i];
    }
    return all > 0 ? hits / all : 1;
}

} // namespace

void aim_at_casters(RenderContext& context, std::span<const glm::vec4> points) {
    DeviceScene& scene = context.on_device;
    const LightTable& table = scene.light_table;
    if (points.empty() || !scene.casters || !scene.plan.needs(Feature::caustics) ||
        std::none_of(table.lights.begin(), table.lights.end(), is_inside)) {
        return;
    }
    const ViewExtent view = view_extent(points);
    std::vector<glm::vec4> casters =
        caster_spheres(context.device, *scene.casters, scene.positions);
    const auto distance = [&](const glm::vec4& sphere) {
        return glm::distance(glm::dvec3(sphere), view.middle) - double(sphere.w);
    };
    // Spheres at one distance are told apart, so that the order of the file does not matter.
    std::sort(casters.begin(), casters.end(), [&](const glm::vec4& a, const glm::vec4& b) {
        return std::tuple(distance(a), a.x, a.y, a.z) < std::tuple(distance(b), b.x, b.y, b.z);
    });
    casters.resize(std::min(casters.size(), most_candidates));
    std::vector<glm::vec4> targets;
    std::copy_if(casters.begin(), casters.end(), std::back_inserter(targets),
                 [&](const glm::vec4& sphere) {
                     return distance(sphere) < reach * view.distance && sphere.w > 0 &&
                            natural_share(table, sphere) < most_natural_share;
                 });
    targets.resize(std::min<std::size_t>(targets.size(), most_targets));
    if (!targets.empty()) {
        set_targets(context.device, scene, targets, aimed_share);
    }
}

void aim_at_view(RenderContext& context, std::span<const glm::vec4> points) {
    constexpr double share = 0.1;  // of the photons
    constexpr double within = 0.9; // share of the points in the sphere, but for the margin
    constexpr double margin = 1.2;
    constexpr double most_extent = 0.25; // over the scene's; more is hit often enough
    DeviceScene& scene = context.on_device;
    if (points.empty()) {
        return;
    }
    const glm::dvec3 middle = view_extent(points).middle;
    std::vector<double> distances;
    distances.reserve(points.size());
    for (const glm::vec4& point : points) {
        distances.push_back(glm::distance(glm::dvec3(point), middle));
    }
    const double radius = margin * quantile(std::move(distances), within);
    if (radius > 0 && radius < most_extent * scene.record.radius) {
        set_view(context.device, scene, {middle, radius}, share);
    }
}

} // namespace argand
