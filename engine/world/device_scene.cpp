#include "world/device_scene.hpp"

#include "scene/material_record.hpp"
#include "shared/follow.h"
#include "shared/lights.h"
#include "shared/morton.h"
#include "shared/photon_records.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <unordered_set>

namespace argand {

namespace {

LightRecord record_of(const Light& light) {
    LightRecord record{};
    switch (light.kind) { // without a default, so that the compiler finds a kind that is missing
    case LightKind::point:
        record.kind = light_point;
        break;
    case LightKind::spot:
        record.kind = light_spot;
        break;
    case LightKind::directional:
        record.kind = light_directional;
        break;
    }
    record.x = light.position.x;
    record.y = light.position.y;
    record.z = light.position.z;
    record.dx = light.direction.x;
    record.dy = light.direction.y;
    record.dz = light.direction.z;
    record.r = light.intensity.r;
    record.g = light.intensity.g;
    record.b = light.intensity.b;
    record.cos_inner = std::cos(light.inner_cone_angle);
    record.cos_outer = std::cos(light.outer_cone_angle);
    return record;
}

LightRecord record_of(const Scene& scene, const glm::uvec3& triangle, const Material& material) {
    const glm::vec3& a = scene.positions[triangle.x];
    const glm::vec3& b = scene.positions[triangle.y];
    const glm::vec3& c = scene.positions[triangle.z];
    LightRecord record{};
    record.kind = light_triangle;
    record.x = a.x;
    record.y = a.y;
    record.z = a.z;
    record.dx = b.x;
    record.dy = b.y;
    record.dz = b.z;
    record.ex = c.x;
    record.ey = c.y;
    record.ez = c.z;
    record.r = material.emission.r;
    record.g = material.emission.g;
    record.b = material.emission.b;
    record.double_sided = material.double_sided ? 1u : 0u;
    return record;
}

std::vector<LightRecord> collect_lights(const Scene& scene) {
    std::vector<LightRecord> lights;
    for (const Light& light : scene.lights) {
        lights.push_back(record_of(light));
    }
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const Material& material = scene.materials[scene.triangle_material[i]];
        if (emits(material)) {
            lights.push_back(record_of(scene, scene.triangles[i], material));
        }
    }
    if (scene.sky && glm::any(glm::greaterThan(*scene.sky, glm::vec3(0)))) {
        LightRecord sky{};
        sky.kind = light_sky;
        sky.r = scene.sky->r;
        sky.g = scene.sky->g;
        sky.b = scene.sky->b;
        lights.push_back(sky);
    }
    return lights;
}

using Corners = std::array<float, 9>;

struct HashCorners {
    std::size_t operator()(const Corners& corners) const {
        std::size_t hash = 0;
        for (const float x : corners) {
            hash = (hash ^ std::hash<float>()(x)) * 0x100000001b3;
        }
        return hash;
    }
};

/// Area of each triangle on which photons may lie: 0 for mirrors, glass and what is black, and 0
/// for duplicates with the same front, of which rays hit only the first.
std::vector<double> areas_for_photons(const Scene& scene, float follow_roughness) {
    std::vector<bool> stores;
    for (const Material& material : scene.materials) {
        stores.push_back(estimated_lobes(material_record(material), follow_roughness) != 0);
    }
    std::vector<double> areas;
    areas.reserve(scene.triangles.size());
    std::unordered_set<Corners, HashCorners> there;
    there.reserve(scene.triangles.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const glm::uvec3& t = scene.triangles[i];
        std::array<std::array<float, 3>, 3> v;
        for (int k = 0; k < 3; ++k) {
            const glm::vec3& p = scene.positions[t[k]];
            v[static_cast<std::size_t>(k)] = {p.x, p.y, p.z};
        }
        std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
        const bool is_new = there.insert(std::bit_cast<Corners>(v)).second;
        areas.push_back(is_new && stores[scene.triangle_material[i]] ? area(scene, i) : 0);
    }
    return areas;
}

/// The triangles along a space-filling curve, so that equal steps of area are evenly spread over
/// the surfaces whatever the order of the file.
std::vector<std::uint32_t> in_curve_order(const Scene& scene, const Bounds& box) {
    std::vector<std::uint64_t> codes(scene.triangles.size());
    for (std::size_t i = 0; i < codes.size(); ++i) {
        const glm::uvec3& t = scene.triangles[i];
        const glm::vec3 center =
            (scene.positions[t.x] + scene.positions[t.y] + scene.positions[t.z]) / 3.0f;
        codes[i] = std::uint64_t(morton30(center, box.low, box.high)) << 32 | i;
    }
    std::sort(codes.begin(), codes.end());
    std::vector<std::uint32_t> order;
    order.reserve(codes.size());
    for (const std::uint64_t code : codes) {
        order.push_back(static_cast<std::uint32_t>(code));
    }
    return order;
}

std::vector<AreaSumRecord> area_sums(const std::vector<std::uint32_t>& order,
                                     const std::vector<double>& areas, double total) {
    std::vector<AreaSumRecord> sums;
    sums.reserve(areas.size());
    const double scale = 4294967296.0 / std::max(total, 1e-30);
    double sum = 0;
    for (const std::uint32_t triangle : order) {
        sums.push_back({static_cast<std::uint32_t>(std::min(sum * scale, 4294967295.0)), triangle});
        sum += areas[triangle];
    }
    return sums;
}

std::vector<glm::vec4> padded(const std::vector<glm::vec3>& vectors) {
    std::vector<glm::vec4> result;
    result.reserve(vectors.size());
    for (const glm::vec3& v : vectors) {
        result.emplace_back(v, 0.0f);
    }
    return result;
}

/// Bound where a kernel does not read its buffer.
Buffer nothing(Device& device) { return device.allocate("not needed", sizeof(glm::vec4)); }

/// The lights of a scene, and how one of them is chosen.
struct LightTable {
    std::vector<LightRecord> lights;
    std::vector<double> weights; ///< of each light: mean power of the channels
    glm::dvec3 power{0};
    double weight = 0, sky_weight = 0, emitter_weight = 0; ///< of all, of the sky, of triangles
};

LightTable make_light_table(const Scene& scene, float scene_radius) {
    LightTable table;
    table.lights = collect_lights(scene);
    for (const LightRecord& light : table.lights) {
        const glm::vec3 power = light_power(light, all_light_kinds, scene_radius);
        const double weight = (double(power.r) + power.g + power.b) / 3;
        table.power += glm::dvec3(power);
        table.weights.push_back(weight);
        table.weight += weight;
        table.sky_weight += light.kind == light_sky ? weight : 0;
        table.emitter_weight += light.kind == light_triangle ? weight : 0;
    }
    return table;
}

SceneRecord scene_record(const Scene& scene, const LightTable& lights, glm::vec3 center,
                         float radius) {
    SceneRecord record{};
    record.center_x = center.x;
    record.center_y = center.y;
    record.center_z = center.z;
    record.radius = radius;
    if (scene.sky) {
        record.sky_r = scene.sky->r;
        record.sky_g = scene.sky->g;
        record.sky_b = scene.sky->b;
    }
    const bool lit = lights.weight > 0;
    record.light_count = lit ? static_cast<std::uint32_t>(lights.lights.size()) : 0;
    record.light_weight = static_cast<float>(lights.weight);
    record.sky_probability = lit ? static_cast<float>(lights.sky_weight / lights.weight) : 0;
    record.emitter_probability =
        lit ? static_cast<float>(lights.emitter_weight / lights.weight) : 0;
    record.triangle_count = static_cast<std::uint32_t>(scene.triangles.size());
    return record;
}

/// Of each triangle the vertices and the material.
std::vector<glm::uvec4> triangle_records(const Scene& scene) {
    std::vector<glm::uvec4> triangles;
    triangles.reserve(scene.triangles.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        triangles.emplace_back(scene.triangles[i], scene.triangle_material[i]);
    }
    return triangles;
}

std::vector<MaterialRecord> material_records(const Scene& scene) {
    std::vector<MaterialRecord> materials;
    materials.reserve(scene.materials.size());
    for (const Material& material : scene.materials) {
        materials.push_back(material_record(material));
    }
    return materials;
}

} // namespace

kernels::SceneBindings DeviceScene::bindings() const {
    return {.scene = scene,
            .positions = positions,
            .normals = normals,
            .triangles = triangles,
            .materials = materials,
            .lights = lights,
            .light_choices = light_choices};
}

kernels::SceneConstants DeviceScene::constants() const {
    return {.smooth_normals = plan.needs(Feature::smooth_normals),
            .several_lights = plan.needs(Feature::several_lights),
            .light_kinds = plan.light_kinds()};
}

DeviceScene upload_scene(Device& device, const Scene& scene, const Plan& plan) {
    const StageScope stage(device, "upload scene");
    const Bounds box = bounds(scene);
    const glm::vec3 center = box.low + 0.5f * (box.high - box.low);
    // A little more than half the diagonal, so that the sphere contains the box in spite of
    // rounding.
    const float radius = 0.50001f * glm::length(box.high - box.low);
    const LightTable lights = make_light_table(scene, radius);

    DeviceScene result;
    result.plan = plan;
    result.power = lights.power;
    result.record = scene_record(scene, lights, center, radius);
    result.record.follow_roughness = plan.request.follow_roughness;
    result.scene = upload<SceneRecord>(device, "scene", std::span(&result.record, 1));
    result.positions = upload(device, "positions", padded(scene.positions));
    result.normals = plan.needs(Feature::smooth_normals)
                         ? upload(device, "normals", padded(scene.normals))
                         : nothing(device);
    result.triangles = upload(device, "triangles", triangle_records(scene));
    result.materials = upload(device, "materials", material_records(scene));
    result.lights = upload(device, "lights", lights.lights);
    if (plan.needs(Feature::photon_map)) {
        const std::vector<double> areas = areas_for_photons(scene, plan.request.follow_roughness);
        result.surface_area = std::accumulate(areas.begin(), areas.end(), 0.0);
        result.area_sums = upload(
            device, "area sums", area_sums(in_curve_order(scene, box), areas, result.surface_area));
    } else {
        result.area_sums = nothing(device);
    }
    result.light_choices = plan.needs(Feature::several_lights)
                               ? upload(device, "light choices", alias_table(lights.weights))
                               : nothing(device);
    result.bvh = build_triangle_bvh(device, result.positions, result.triangles,
                                    result.record.triangle_count);
    return result;
}

CameraRecord camera_record(const Camera& camera, int width, int height) {
    const auto w = static_cast<float>(width);
    const auto h = static_cast<float>(height);
    const bool perspective = camera.kind == CameraKind::perspective;
    // Half the picture's height at unit distance; for orthographic cameras, in the scene's units.
    const float half =
        perspective ? std::tan(0.5f * camera.vertical_angle) : camera.vertical_extent;
    const glm::vec3 across = camera.right * (2 * half / h);
    const glm::vec3 down = -camera.up * (2 * half / h);
    const glm::vec3 corner = -0.5f * w * across - 0.5f * h * down;
    const glm::vec3 origin = perspective ? camera.position : camera.position + corner;
    const glm::vec3 forward = perspective ? camera.forward + corner : camera.forward;
    CameraRecord record{};
    record.origin_x = origin.x;
    record.origin_y = origin.y;
    record.origin_z = origin.z;
    record.origin_share = perspective ? 0.0f : 1.0f;
    record.forward_x = forward.x;
    record.forward_y = forward.y;
    record.forward_z = forward.z;
    record.across_x = across.x;
    record.across_y = across.y;
    record.across_z = across.z;
    record.down_x = down.x;
    record.down_y = down.y;
    record.down_z = down.z;
    return record;
}

} // namespace argand
