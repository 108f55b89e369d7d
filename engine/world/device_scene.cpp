#include "world/device_scene.hpp"

#include "world/texture_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

namespace argand {

namespace {

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
    record.light_count = lights.light_count;
    record.first_emitter = lights.first_triangle;
    record.emitter_count = lights.triangle_count;
    record.attributes = attributes_of_vertex(scene);
    record.color_attribute = scene.uv_sets;
    record.first_tangent = first_tangent(scene);
    record.triangle_count = static_cast<std::uint32_t>(scene.triangles.size());
    return record;
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

kernels::TextureBindings DeviceScene::texture_bindings() const {
    return {.attributes = attributes, .textures = textures, .texels = texels};
}

kernels::TextureConstants DeviceScene::texture_constants() const {
    return {.textured = plan.needs(Feature::textures),
            .vertex_colors = plan.needs(Feature::vertex_colors),
            .emissive_texels = plan.needs(Feature::emissive_textures),
            .normal_maps = plan.needs(Feature::normal_textures),
            .other_textures = plan.needs(Feature::other_textures),
            .mip_maps = plan.needs(Feature::mip_maps)};
}

Buffer unneeded(Device& device) { return device.allocate("not needed", sizeof(glm::vec4)); }

void prepare_scene(Device& device, const Scene& scene, const Bounds& box,
                   const std::vector<std::uint32_t>& shining, const TexelTrees& texels,
                   DeviceScene& result) {
    result.box = box;
    const glm::vec3 center = box.low + 0.5f * (box.high - box.low);
    // A little more than half the diagonal, so that the sphere contains the box in spite of
    // rounding.
    const float radius = 0.50001f * glm::length(box.high - box.low);

    if (result.emissive) {
        result.light_table =
            make_light_table(device, scene, *result.emissive, result.positions, result.triangles,
                             result.materials, radius, result.lights);
    } else {
        result.light_table = make_light_table(scene, shining, texels, radius);
        result.lights = upload(device, "lights", result.light_table.lights);
    }
    result.record = scene_record(scene, result.light_table, center, radius);
    result.record.sky_columns =
        result.sky_table ? static_cast<std::uint32_t>(result.sky_table->width) : 0;
    result.record.follow_roughness = result.plan.request.follow_roughness;
    result.record.cull_back_faces = result.plan.request.cull_back_faces ? 1 : 0;
    result.aim_nodes = unneeded(device);
    const std::vector<double> shares = plain_shares(result.light_table);
    set_light_choices(device, result, shares, shares);
}

void set_light_choices(Device& device, DeviceScene& scene, const std::vector<double>& for_rays,
                       const std::vector<double>& for_photons) {
    const LightTable& table = scene.light_table;
    scene.ray_shares = for_rays;
    scene.photon_shares = for_photons;
    std::vector<LightChoice> choices = light_choices(table, for_rays);
    const auto share_of_kind = [&](std::uint32_t kind) {
        double share = 0;
        for (std::size_t i = 0; i < choices.size(); ++i) {
            share += table.lights[i].kind == kind ? choices[i].probability : 0;
        }
        return static_cast<float>(share);
    };
    scene.record.sky_probability = share_of_kind(light_sky) + share_of_kind(light_picture);
    scene.record.emitter_probability = share_of_kind(light_triangle);
    scene.scene = upload<SceneRecord>(device, "scene", std::span(&scene.record, 1));
    if (!scene.plan.needs(Feature::several_lights)) {
        scene.light_choices = unneeded(device);
        return;
    }
    const std::vector<LightChoice> of_photons = light_choices(table, for_photons);
    if (scene.emissive) {
        scene.light_choices =
            choices_of_lights(device, table, *scene.emissive, scene.lights, choices, of_photons);
        return;
    }
    choices.insert(choices.end(), of_photons.begin(), of_photons.end());
    scene.light_choices = upload(device, "light choices", choices);
}

float radius_around(const glm::vec3& point, const SceneRecord& scene) {
    constexpr float rounding = 1.0001f;
    const glm::vec3 center(scene.center_x, scene.center_y, scene.center_z);
    return rounding * (scene.radius + glm::distance(point, center));
}

float position_error(const SceneRecord& scene) {
    const double reach =
        glm::length(glm::dvec3(scene.center_x, scene.center_y, scene.center_z)) + scene.radius;
    return static_cast<float>(reach * 8 * std::numeric_limits<float>::epsilon());
}

void set_aims(Device& device, DeviceScene& scene, std::vector<LightAim> aims) {
    LightTable& table = scene.light_table;
    std::erase_if(aims, [&](const LightAim& aim) {
        return aim.row >= table.lights.size() || !is_from_outside(table.lights[aim.row]);
    });
    if (aims.empty()) {
        return;
    }
    std::vector<AimNode> nodes(1, {aim_leaf, 0, 0, 0});
    for (const LightAim& aim : aims) {
        LightRecord& light = table.lights[aim.row];
        light.x = aim.middle.x;
        light.y = aim.middle.y;
        light.z = aim.middle.z;
        light.ex = radius_around(aim.middle, scene.record);
        const auto root = static_cast<std::uint32_t>(nodes.size());
        light.triangle_and_sides = root;
        std::transform(aim.tree.begin(), aim.tree.end(), std::back_inserter(nodes),
                       [&](AimNode node) {
                           node.child += root;
                           return node;
                       });
        const std::size_t index = table.first_light.empty() ? aim.row : table.first_light[aim.row];
        device.upload(scene.lights, index * sizeof(LightRecord),
                      std::as_bytes(std::span(&light, 1)));
    }
    // Trees of other sizes take the same memory in later frames.
    nodes.resize(1 + aims.size() * most_aim_nodes, {aim_leaf, 0, 0, 0});
    scene.aims = std::move(aims);
    scene.aim_nodes = upload(device, "aim nodes", nodes);
}

void set_targets(Device& device, DeviceScene& scene, std::span<const glm::vec4> spheres,
                 double share) {
    SceneRecord& record = scene.record;
    const std::array<lane4*, most_targets> targets = {&record.target_0, &record.target_1,
                                                      &record.target_2, &record.target_3};
    record.target_count = static_cast<std::uint32_t>(std::min(spheres.size(), targets.size()));
    for (std::size_t i = 0; i < record.target_count; ++i) {
        *targets[i] = spheres[i];
    }
    record.target_share = static_cast<float>(share / std::max(record.target_count, 1u));
    scene.scene = upload<SceneRecord>(device, "scene", std::span(&record, 1));
}

void set_view(Device& device, DeviceScene& scene, const glm::vec4& sphere, double share) {
    scene.record.view = sphere;
    scene.record.view_share = static_cast<float>(share);
    scene.scene = upload<SceneRecord>(device, "scene", std::span(&scene.record, 1));
}

void set_near_field(Device& device, DeviceScene& scene, float distance, bool follows) {
    scene.record.near_distance = distance;
    scene.record.follows_near = follows ? 1 : 0;
    scene.scene = upload<SceneRecord>(device, "scene", std::span(&scene.record, 1));
}

void set_close_lights(Device& device, DeviceScene& scene, std::span<const CloseLight> lights,
                      double share) {
    SceneRecord& record = scene.record;
    record.close_light_count =
        static_cast<std::uint32_t>(std::min<std::size_t>(lights.size(), most_close_lights));
    for (std::size_t i = 0; i < record.close_light_count; ++i) {
        record.close_lights[i] = lane4(lights[i].position, lights[i].close);
        record.close_reaches[i] = lights[i].reach;
    }
    record.close_share = static_cast<float>(share / std::max(record.close_light_count, 1u));
    scene.scene = upload<SceneRecord>(device, "scene", std::span(&record, 1));
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
