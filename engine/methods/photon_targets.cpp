#include "methods/photon_targets.hpp"

#include "base/disjoint_sets.hpp"
#include "base/hash_floats.hpp"
#include "methods/view_extent.hpp"
#include "scene/material_record.hpp"
#include "shared/follow.h"
#include "shared/lights.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <tuple>
#include <unordered_map>

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

glm::vec4 sphere_around(const Bounds& box) {
    const glm::vec3 center = 0.5f * (box.low + box.high);
    return {center, 1.001f * glm::distance(center, box.high)};
}

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

bool is_inside(const LightRecord& light) {
    return ((1u << light.kind) & light_kinds_from_outside) == 0;
}

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

/// For each material whether its light is followed: glass, mirrors, and what is nearly one.
std::vector<bool> are_followed(const Scene& scene, float follow_roughness) {
    std::vector<bool> followed;
    followed.reserve(scene.materials.size());
    for (const Material& material : scene.materials) {
        followed.push_back(followed_lobes(material_record(material), follow_roughness) != 0);
    }
    return followed;
}

} // namespace

std::vector<glm::vec4> caustic_casters(const PlacedScene& placed, float follow_roughness) {
    const Scene& scene = placed.scene;
    const std::vector<bool> casts = are_followed(scene, follow_roughness);
    // Casting triangles that have a corner at the same place belong to one caster.
    DisjointSets sets(scene.triangles.size());
    std::unordered_map<std::array<float, 3>, std::uint32_t, HashFloats> triangle_at;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        if (casts[scene.triangle_material[i]]) {
            for (int k = 0; k < 3; ++k) {
                const glm::vec3& p = placed.positions[scene.triangles[i][k]];
                sets.join(triangle_at.try_emplace({p.x, p.y, p.z}, i).first->second, i);
            }
        }
    }
    std::unordered_map<std::uint32_t, Bounds> boxes;
    for (const auto& [position, triangle] : triangle_at) {
        Bounds& box = boxes[sets.root(triangle)];
        const glm::vec3 p(position[0], position[1], position[2]);
        box.low = glm::min(box.low, p);
        box.high = glm::max(box.high, p);
    }
    std::vector<glm::vec4> spheres;
    spheres.reserve(boxes.size());
    for (const auto& [root, box] : boxes) {
        spheres.push_back(sphere_around(box));
    }
    return spheres;
}

void aim_at_casters(RenderContext& context, std::span<const glm::vec4> points) {
    DeviceScene& scene = context.on_device;
    const LightTable& table = scene.light_table;
    if (points.empty() || !scene.plan.needs(Feature::caustics) ||
        std::none_of(table.lights.begin(), table.lights.end(), is_inside)) {
        return;
    }
    const ViewExtent view = view_extent(points);
    std::vector<glm::vec4> casters =
        caustic_casters(scene.placed(context.scene), scene.plan.request.follow_roughness);
    const auto distance = [&](const glm::vec4& sphere) {
        return glm::distance(glm::dvec3(sphere), view.middle) - double(sphere.w);
    };
    // Spheres at one distance are told apart, so that their order does not depend on the hash.
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
    constexpr double within = 0.8; // share of the points in the sphere, but for the margin
    constexpr double margin = 1.2;
    constexpr double most_extent = 0.25; // over the scene's; more is hit often enough
    DeviceScene& scene = context.on_device;
    // Mirrors and glass show what lies elsewhere, at which no photons are aimed. (The plan has
    // followed paths with --everything, too, which must not change the picture.)
    const std::vector<bool> followed =
        are_followed(context.scene, scene.plan.request.follow_roughness);
    const std::vector<std::uint32_t>& used = context.scene.triangle_material;
    if (points.empty() || std::any_of(used.begin(), used.end(),
                                      [&](std::uint32_t material) { return followed[material]; })) {
        return;
    }
    const glm::dvec3 middle = view_extent(points).middle;
    std::vector<double> distances;
    distances.reserve(points.size());
    for (const glm::vec4& point : points) {
        distances.push_back(glm::distance(glm::dvec3(point), middle));
    }
    const auto rank = static_cast<std::size_t>(within * static_cast<double>(distances.size() - 1));
    std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(rank),
                     distances.end());
    const double radius = margin * distances[rank];
    if (radius > 0 && radius < most_extent * scene.record.radius) {
        set_view(context.device, scene, {middle, radius}, share);
    }
}

} // namespace argand
