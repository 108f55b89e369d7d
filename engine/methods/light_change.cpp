#include "methods/light_change.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace argand {

namespace {

constexpr double infinity_of_change = std::numeric_limits<double>::infinity();
// What moves changes light elsewhere only.
constexpr double most_by_meshes = 0.25;

double distance_of(const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b); }

/// The change of one light.
double change_of(const LightRecord& a, const LightRecord& b, double distance) {
    if (a.kind != b.kind ||
        (a.kind == light_triangle && a.triangle_and_sides != b.triangle_and_sides) ||
        (a.kind == light_picture && (a.dx != b.dx || a.dy != b.dy))) {
        return infinity_of_change;
    }
    // Lights from outside have no place: what stands there is how their photons are aimed.
    double moved = is_from_outside(a) ? 0 : distance_of({a.x, a.y, a.z}, {b.x, b.y, b.z});
    double turned = 0;
    const glm::dvec3 a_d(a.dx, a.dy, a.dz);
    const glm::dvec3 b_d(b.dx, b.dy, b.dz);
    if (a.kind == light_triangle) {
        moved = std::max(
            {moved, distance_of(a_d, b_d), distance_of({a.ex, a.ey, a.ez}, {b.ex, b.ey, b.ez})});
    } else {
        turned = distance_of(a_d, b_d) + std::abs(double(a.cos_inner) - b.cos_inner) +
                 std::abs(double(a.cos_outer) - b.cos_outer);
    }
    const glm::dvec3 from(a.r, a.g, a.b);
    const glm::dvec3 to(b.r, b.g, b.b);
    const double most = std::max({from.r, from.g, from.b, to.r, to.g, to.b});
    const double brighter = most > 0 ? distance_of(from, to) / most : 0;
    return std::max({distance > 0 ? moved / distance
                     : moved > 0  ? infinity_of_change
                                  : 0,
                     turned, brighter});
}

} // namespace

std::vector<double> light_changes(const LightTable& before, const LightTable& now,
                                  double distance) {
    std::vector<double> changes;
    changes.reserve(now.lights.size());
    for (std::size_t i = 0; i < now.lights.size(); ++i) {
        changes.push_back(change_of(before.lights[i], now.lights[i], distance));
    }
    return changes;
}

double light_change(const LightTable& before, const LightTable& now, double distance) {
    if (before.lights.size() != now.lights.size()) {
        return infinity_of_change;
    }
    double change = 0;
    for (const double of_light : light_changes(before, now, distance)) {
        change = std::max(change, of_light);
    }
    return change;
}

double SceneChange::most() const {
    double change = of_all;
    for (const double of_light : of_lights) {
        change = std::max(change, of_light);
    }
    return change;
}

SeenScene seen_of(const DeviceScene& scene) {
    return {scene.light_table, scene.meshes, scene.last_material_change};
}

SceneChange scene_change(const SeenScene& seen, const DeviceScene& now) {
    const double distance = now.record.radius;
    SceneChange change;
    if (seen.lights.lights.size() == now.light_table.lights.size()) {
        change.of_lights = light_changes(seen.lights, now.light_table, distance);
    } else {
        change.of_all = infinity_of_change;
    }
    if (seen.last_material_change != now.last_material_change) {
        change.of_all = infinity_of_change;
    }
    const auto add_box = [&](const Bounds& b) {
        if (b.low.x <= b.high.x) { // else there is no triangle
            change.moved.push_back({b.low.x, b.low.y, b.low.z, 0, b.high.x, b.high.y, b.high.z, 0});
        }
    };
    change.moved.reserve(2 * now.meshes.size());
    for (std::size_t i = 0; i < now.meshes.size(); ++i) {
        if (now.meshes[i].last_moved == seen.meshes[i].last_moved) {
            continue;
        }
        const Bounds& from = seen.meshes[i].box;
        const Bounds& to = now.meshes[i].box;
        add_box(from);
        add_box(to);
        const double step =
            std::max(glm::distance(from.low, to.low), glm::distance(from.high, to.high));
        change.by_meshes = std::max(change.by_meshes, std::min(step / distance, most_by_meshes));
    }
    return change;
}

double balanced_half_life(double change, double window, double in_disc) {
    // With weights 2^(-age/h) the mean age is 1.44 h, and the noise that of 2.9 h of the window's
    // blocks: (1.44 change h)² + window / (2.9 h in_disc) is least at this h.
    constexpr double of_balance = 12;
    return change > 0 ? std::cbrt(window / (of_balance * std::max(in_disc, 1.0) * change * change))
                      : infinity_of_change;
}

} // namespace argand
