#pragma once

#include "scene/pose.hpp"
#include "scenes.hpp"

#include <cmath>
#include <utility>

namespace argand::testing {

/// Keys at 0 and 1 second.
inline KeyFrames between(const glm::dvec3& from, const glm::dvec3& to) {
    return {.times = {0, 1}, .values = {from.x, from.y, from.z, to.x, to.y, to.z}, .width = 3};
}

inline KeyFrames between(double from, double to) { return {.times = {0, 1}, .values = {from, to}}; }

/// A room that is dark at 0 s. Until 1 s its lamp and a wall begin to shine, another wall changes
/// its colour, and the block becomes glass.
inline Scene changing_scene() {
    Scene scene = room_scene();
    scene.name = "changing";
    scene.motion.nodes.resize(1);
    scene.motion.nodes[0].rest.translation = glm::dvec3(scene.lights[0].position);
    scene.motion.light_keys.push_back({.intensity = between(0, 1)});
    Light lamp = scene.lights[0];
    lamp.position = glm::vec3(0);
    scene.motion.lights.push_back(
        {.light = lamp, .keys = 0, .factors = {.color = glm::dvec3(1, 0.9, 0.7)}});
    MaterialKeys keys[3];
    keys[0].emissive = between({0, 0, 0}, {0.5, 0.25, 0});
    keys[1].base_color =
        KeyFrames{.times = {0, 1}, .values = {0.2, 0.6, 0.2, 1, 0.8, 0.1, 0.1, 1}, .width = 4};
    keys[2].transmission = between(0, 1);
    for (std::size_t i = 0; i < 3; ++i) {
        MaterialFactors factors{.metallic = 0, .specular = 0, .thickness = 1};
        factors.base_color = glm::dvec4(scene.materials[i].base_color, 1);
        scene.motion.materials.push_back({i, factors, keys[i]});
    }
    move_to(0, scene);
    return scene;
}

/// A room with a smooth, moving fan of triangles, a mirrored one, and a moving lamp beside those
/// that stand still.
inline Scene moving_scene(std::uint32_t triangles = 50) {
    Scene scene = room_scene();
    scene.name = "moving";
    scene.motion.nodes.resize(3);
    scene.motion.nodes[0].keys.translation = between({-0.5, 0.3, 0}, {0.5, 0.6, 0.2});
    scene.motion.nodes[1].keys.scale = between({0.5, 0.5, 0.5}, {-0.5, 0.5, 0.5});
    scene.motion.nodes[2].keys.translation = between({0, 1, 0}, {0.5, 1, 0.5});
    for (const std::uint32_t node : {0u, 1u}) {
        MovingMesh mesh{.name = "fan",
                        .node = node,
                        .first_vertex = scene.positions.size(),
                        .first_triangle = scene.triangles.size(),
                        .triangles = triangles};
        const auto first = static_cast<std::uint32_t>(mesh.first_vertex);
        mesh.positions.emplace_back(0, 0, 0);
        for (std::uint32_t i = 0; i <= triangles; ++i) {
            const float angle = 6.0f * static_cast<float>(i) / static_cast<float>(triangles);
            mesh.positions.emplace_back(0.4f * std::cos(angle), 0.4f * std::sin(angle),
                                        0.1f * std::sin(5 * angle));
        }
        mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
        for (std::uint32_t i = 1; i <= triangles; ++i) {
            scene.triangles.emplace_back(first, first + i, first + i + 1);
            scene.triangle_material.push_back(0);
        }
        scene.positions.resize(scene.positions.size() + mesh.positions.size());
        scene.normals.resize(scene.positions.size());
        scene.motion.meshes.push_back(std::move(mesh));
    }
    Light lamp;
    lamp.intensity = glm::vec3(0.2f);
    scene.lights.push_back(lamp);
    scene.motion.lights.push_back({.node = 2, .index = scene.lights.size() - 1, .light = lamp});
    move_to(0, scene);
    return scene;
}

} // namespace argand::testing
