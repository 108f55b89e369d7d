#include "methods/close_lights.hpp"

#include "accel/triangle_bvh.hpp"
#include "shared/lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace argand {

namespace {

// Share of the scattered eye paths that is aimed, for all lights together.
constexpr double aimed_share = 0.25;
// Lights that are looked at, the strongest ones, and directions of each.
constexpr std::size_t most_lights = 64;
constexpr std::uint32_t directions = 256;
// A light is close to surfaces if it lights them as brightly as a sphere around it of this radius,
// over the distance of the surfaces that are farthest away (but for a twentieth of the directions).
constexpr double closeness = 1.0 / 16;
constexpr double farthest_rank = 0.95;
// Greatest distance at which aimed paths pass a light, over the same.
constexpr double reach = 0.25;

struct Surroundings {
    double close;    // radius of a sphere around the light that would be as bright as the surfaces
    double farthest; // distance of the farthest surfaces
};

/// Directions of even density over the light's cone (the sphere, for a point light).
glm::vec3 direction_from(const LightRecord& light, std::uint32_t i) {
    const float least = light.kind == light_spot ? light.cos_outer : -1.0f;
    const double turn = 2 * std::numbers::pi * std::fmod(i * (std::numbers::phi - 1), 1.0);
    const double z = 1 - (1 - double(least)) * (i + 0.5) / directions;
    const double across = std::sqrt(std::max(1 - z * z, 0.0));
    const bool spot = light.kind == light_spot;
    const Frame frame = make_frame(spot ? light_direction(light) : vec3(0, 0, 1));
    return to_world(frame, vec3(across * std::cos(turn), across * std::sin(turn), z));
}

/// The lamps that send most shadow rays.
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
    for (const std::size_t row : rows) {
        lamps.push_back(table.lights[row]);
    }
    return lamps;
}

std::vector<HitRecord> look_around(Device& device, const DeviceScene& scene,
                                   const std::vector<LightRecord>& lamps) {
    std::vector<RayRecord> rays;
    std::vector<std::uint32_t> active;
    for (const LightRecord& lamp : lamps) {
        for (std::uint32_t i = 0; i < directions; ++i) {
            const glm::vec3 d = direction_from(lamp, i);
            active.push_back(static_cast<std::uint32_t>(rays.size()));
            rays.push_back({lamp.x, lamp.y, lamp.z, far_away, d.x, d.y, d.z, 0});
        }
    }
    Traversal traversal = make_traversal(device, rays.size());
    traversal.careful = true;
    const Buffer ray_buffer = upload(device, "rays around lamps", rays);
    const Buffer active_buffer = upload(device, "rays around lamps", active);
    const Buffer hits = device.allocate("hits around lamps", rays.size() * sizeof(HitRecord));
    trace_closest(device, scene.bvh, traversal,
                  {.rays = ray_buffer,
                   .active = active_buffer,
                   .results = hits,
                   .count = static_cast<std::uint32_t>(rays.size())});
    return download<HitRecord>(device, hits, rays.size());
}

/// hits: of the rays of one lamp; rays that meet nothing do not count.
Surroundings surroundings(std::span<const HitRecord> hits) {
    std::vector<double> distances;
    double brightness = 0;
    for (const HitRecord& hit : hits) {
        if (hit.triangle != no_triangle) {
            distances.push_back(hit.t);
            brightness += 1 / std::max(double(hit.t) * hit.t, 1e-300);
        }
    }
    if (distances.empty()) {
        return {0, 0};
    }
    const auto rank = static_cast<std::size_t>(farthest_rank * double(distances.size() - 1));
    std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(rank),
                     distances.end());
    return {1 / std::sqrt(brightness / static_cast<double>(hits.size())), distances[rank]};
}

} // namespace

void aim_at_close_lights(RenderContext& context) {
    DeviceScene& scene = context.on_device;
    const std::vector<LightRecord> lamps = strongest_lamps(scene);
    std::vector<glm::vec4> close;
    double farthest = 0;
    if (!lamps.empty() && scene.bvh.triangle_count > 0 && context.settings.bounces > 0) {
        const std::vector<HitRecord> hits = look_around(context.device, scene, lamps);
        for (std::size_t i = 0; i < lamps.size() && close.size() < most_close_lights; ++i) {
            const Surroundings around =
                surroundings(std::span(hits).subspan(i * directions, directions));
            if (around.close < closeness * around.farthest) {
                close.emplace_back(lamps[i].x, lamps[i].y, lamps[i].z, around.close);
                farthest = std::max(farthest, around.farthest);
            }
        }
    }
    set_close_lights(context.device, scene, close, reach * farthest, aimed_share);
}

} // namespace argand
