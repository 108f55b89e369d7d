#include "methods/light_change.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace argand {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double distance_of(const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b); }

/// The change of one light.
double change_of(const LightRecord& a, const LightRecord& b, double distance) {
    if (a.kind != b.kind || a.triangle_and_sides != b.triangle_and_sides) {
        return infinity;
    }
    double moved = distance_of({a.x, a.y, a.z}, {b.x, b.y, b.z});
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
    return std::max({distance > 0 ? moved / distance : moved > 0 ? infinity : 0, turned, brighter});
}

} // namespace

double light_change(const LightTable& before, const LightTable& now, double distance) {
    if (before.lights.size() != now.lights.size()) {
        return infinity;
    }
    double change = 0;
    for (std::size_t i = 0; i < now.lights.size(); ++i) {
        change = std::max(change, change_of(before.lights[i], now.lights[i], distance));
    }
    return change;
}

double balanced_half_life(double change, double window, double in_disc) {
    // With weights 2^(-age/h) the mean age is 1.44 h, and the noise that of 2.9 h of the window's
    // blocks: (1.44 change h)² + window / (2.9 h in_disc) is least at this h.
    constexpr double of_balance = 12;
    return change > 0 ? std::cbrt(window / (of_balance * std::max(in_disc, 1.0) * change * change))
                      : infinity;
}

} // namespace argand
