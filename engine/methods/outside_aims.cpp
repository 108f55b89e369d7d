#include "methods/outside_aims.hpp"

#include "shared/frame.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace argand {

namespace {

/// The inverse of sample_disc.
glm::dvec2 numbers_of_disc(const glm::dvec2& p) {
    const bool x_longer = std::abs(p.x) > std::abs(p.y);
    const double side = (x_longer ? p.x : p.y) < 0 ? -1 : 1;
    const double r = side * glm::length(p);
    const double eighths = std::atan2(side * p.y, side * p.x) * 4 / std::numbers::pi;
    return 0.5 + 0.5 * (x_longer ? glm::dvec2(r, eighths * r) : glm::dvec2((2 - eighths) * r, r));
}

/// The inverse of sample_sphere.
glm::dvec2 numbers_of_sphere(const glm::dvec3& d) {
    const double turn = std::atan2(d.y, d.x) / (2 * std::numbers::pi);
    return {turn - std::floor(turn), 0.5 - 0.5 * d.z};
}

/// The point that the rays pass nearest, such as the middle of the window through which they come:
/// the least sum of their distances, by reweighted least squares (Weiszfeld 1937 for points).
glm::dvec3 nearest_to_rays(std::span<const FoundLight> found, double scene_radius) {
    constexpr int rounds = 8;
    constexpr double least_distance = 1e-3; // over the scene's radius
    constexpr double pull = 0.01; // towards the last point; parallel rays have no nearest one
    double all = 0;
    glm::dvec3 middle(0);
    for (const FoundLight& f : found) {
        all += f.radiance;
        middle += f.radiance * glm::dvec3(f.point);
    }
    middle /= all;
    for (int round = 0; round < rounds; ++round) {
        glm::dmat3 matrix(0);
        glm::dvec3 sum(0);
        double weights = 0;
        for (const FoundLight& f : found) {
            const glm::dvec3 d(f.direction);
            const glm::dmat3 across = glm::dmat3(1) - glm::outerProduct(d, d);
            const double distance = glm::length(across * (glm::dvec3(f.point) - middle));
            const double weight = f.radiance / (distance + least_distance * scene_radius);
            matrix += weight * across;
            sum += weight * (across * glm::dvec3(f.point));
            weights += weight;
        }
        matrix += glm::dmat3(pull * weights);
        middle = glm::inverse(matrix) * (sum + pull * weights * middle);
    }
    return middle;
}

} // namespace

glm::dvec4 numbers_of_photon(const LightRecord& light, const glm::vec3& middle, double radius,
                             const glm::vec3& point, const glm::vec3& direction,
                             const SkyTable* sky) {
    const bool directional = light.kind == light_directional;
    const Frame frame =
        make_frame(directional ? glm::vec3(light.dx, light.dy, light.dz) : direction);
    const glm::dvec3 to = glm::dvec3(point) - glm::dvec3(middle);
    const glm::dvec2 across(glm::dot(to, glm::dvec3(frame.x)), glm::dot(to, glm::dvec3(frame.y)));
    const glm::dvec2 of_direction = directional ? glm::dvec2(0.5)
                                    : sky       ? numbers_of_direction(*sky, -direction)
                                                : numbers_of_sphere(direction);
    const glm::dvec4 u(of_direction, numbers_of_disc(across / radius));
    return glm::clamp(u, 0.0, double(LARGEST_BELOW_1));
}

std::vector<LightAim> learn_aims(const DeviceScene& scene, std::span<const FoundLight> found) {
    constexpr std::size_t least_samples = 16;
    const LightTable& table = scene.light_table;
    const std::vector<LightRecord>& lights = table.lights;
    std::vector<LightAim> aims;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        if (!is_from_outside(lights[i])) {
            continue;
        }
        std::vector<FoundLight> of_light;
        std::copy_if(found.begin(), found.end(), std::back_inserter(of_light),
                     [&](const FoundLight& f) {
                         return f.indirect && f.radiance > 0 && row_of(table, f.light) == i;
                     });
        if (of_light.size() < least_samples) {
            continue;
        }
        LightAim aim{.row = i, .middle = nearest_to_rays(of_light, scene.record.radius)};
        if (!std::isfinite(glm::length(aim.middle))) {
            continue;
        }
        const double radius = radius_around(aim.middle, scene.record);
        const SkyTable* sky = lights[i].kind == light_picture ? scene.sky_table.get() : nullptr;
        std::vector<AimSample> samples(of_light.size());
        std::transform(of_light.begin(), of_light.end(), samples.begin(), [&](const FoundLight& f) {
            return AimSample{
                .u = numbers_of_photon(lights[i], aim.middle, radius, f.point, f.direction, sky),
                .weight = f.radiance};
        });
        aim.tree = make_aim_tree(samples, lights[i].kind == light_directional ? 2 : 0);
        if (aim.tree.size() > 1) {
            aims.push_back(std::move(aim));
        }
    }
    return aims;
}

} // namespace argand
