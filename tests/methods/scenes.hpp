#pragma once

#include "scene/scene.hpp"

#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <numbers>
#include <random>

namespace argand::testing {

inline constexpr float pi = std::numbers::pi_v<float>;

inline Material lambertian(glm::vec3 albedo) {
    Material m;
    m.base_color = albedo;
    m.metallic = 0;
    m.specular = 0;
    return m;
}

/// A Lambertian surface that also emits from its front.
inline Material emitter(glm::vec3 radiance, glm::vec3 albedo = glm::vec3(0)) {
    Material m = lambertian(albedo);
    m.emission = radiance;
    return m;
}

inline Material mirror(glm::vec3 color = glm::vec3(1)) {
    Material m;
    m.base_color = color;
    m.metallic = 1;
    m.roughness = 0;
    return m;
}

/// A smooth dielectric: the boundary of a solid, or a thin wall.
inline Material glass(float ior, bool solid) {
    Material m;
    m.metallic = 0;
    m.roughness = 0;
    m.transmission = 1;
    m.ior = ior;
    m.thickness = solid ? 1.0f : 0.0f;
    return m;
}

inline std::uint32_t add_material(Scene& scene, const Material& material) {
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

/// Counter-clockwise seen from the front.
inline void add_triangle(Scene& scene, glm::vec3 a, glm::vec3 b, glm::vec3 c,
                         std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    scene.positions.insert(scene.positions.end(), {a, b, c});
    scene.normals.insert(scene.normals.end(), 3, glm::vec3(0));
    scene.triangles.emplace_back(first, first + 1, first + 2);
    scene.triangle_material.push_back(material);
}

/// The parallelogram corner + s·across + t·up with s and t in [0, 1]. Its front faces across × up.
inline void add_quad(Scene& scene, glm::vec3 corner, glm::vec3 across, glm::vec3 up,
                     std::uint32_t material) {
    add_triangle(scene, corner, corner + across, corner + across + up, material);
    add_triangle(scene, corner, corner + across + up, corner + up, material);
}

/// The square floor |x|, |z| <= half at this height, facing up.
inline void add_floor(Scene& scene, float half, float height, std::uint32_t material) {
    add_quad(scene, {-half, height, half}, {2 * half, 0, 0}, {0, 0, -2 * half}, material);
}

/// A box; `inwards`: the fronts of its faces are inside.
inline void add_box(Scene& scene, glm::vec3 low, glm::vec3 high, std::uint32_t material,
                    bool inwards) {
    const glm::vec3 size = high - low;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 across(0), up(0), depth(0);
        across[(axis + 1) % 3] = size[(axis + 1) % 3];
        up[(axis + 2) % 3] = size[(axis + 2) % 3];
        depth[axis] = size[axis];
        // across × up points along the axis: out of the far face, into the box from the near one.
        add_quad(scene, low, inwards ? across : up, inwards ? up : across, material);
        add_quad(scene, low + depth, inwards ? up : across, inwards ? across : up, material);
    }
}

/// A sphere of `rings` × 2·`rings` facets whose fronts are outside; `smooth`: interpolated normals.
inline void add_sphere(Scene& scene, glm::vec3 center, float radius, int rings, bool smooth,
                       std::uint32_t material) {
    const auto unit = [rings](int ring, int segment) {
        const float polar = pi * static_cast<float>(ring) / static_cast<float>(rings);
        const float azimuth =
            pi * static_cast<float>(segment % (2 * rings)) / static_cast<float>(rings);
        return glm::vec3(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                         std::sin(polar) * std::cos(azimuth));
    };
    const auto add = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        add_triangle(scene, center + radius * a, center + radius * b, center + radius * c,
                     material);
        if (smooth) {
            const std::size_t n = scene.normals.size();
            scene.normals[n - 3] = a;
            scene.normals[n - 2] = b;
            scene.normals[n - 1] = c;
        }
    };
    for (int ring = 0; ring < rings; ++ring) {
        for (int segment = 0; segment < 2 * rings; ++segment) {
            const glm::vec3 a = unit(ring, segment);
            const glm::vec3 b = unit(ring + 1, segment);
            const glm::vec3 c = unit(ring + 1, segment + 1);
            const glm::vec3 d = unit(ring, segment + 1);
            if (ring + 1 < rings) {
                add(a, b, c);
            }
            if (ring > 0) {
                add(a, c, d);
            }
        }
    }
}

inline Camera look_at(glm::vec3 from, glm::vec3 to, float vertical_degrees = 45) {
    Camera camera;
    camera.position = from;
    camera.forward = glm::normalize(to - from);
    const glm::vec3 up =
        std::abs(camera.forward.y) > 0.99f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
    camera.right = glm::normalize(glm::cross(camera.forward, up));
    camera.up = glm::cross(camera.right, camera.forward);
    camera.vertical_angle = glm::radians(vertical_degrees);
    return camera;
}

/// A camera with parallel rays that fill a square of this half height.
inline Camera parallel_rays(glm::vec3 from, glm::vec3 to, float half_height) {
    Camera camera = look_at(from, to);
    camera.kind = CameraKind::orthographic;
    camera.vertical_extent = half_height;
    return camera;
}

/// Adds so many square leaves with edges of this size, at random places of a cube and in random
/// directions. extent: half the cube's edge.
inline void add_leaves(Scene& scene, glm::vec3 middle, float extent, float size, int count) {
    Material leaf = lambertian({0.5f, 0.7f, 0.4f});
    leaf.double_sided = true;
    const std::uint32_t material = add_material(scene, leaf);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> within(-1, 1);
    const auto anywhere = [&] { return glm::vec3(within(random), within(random), within(random)); };
    const auto direction = [&] { return glm::normalize(anywhere() + glm::vec3(0, 0, 1e-3f)); };
    for (int i = 0; i < count; ++i) {
        const glm::vec3 across = direction();
        const glm::vec3 up = glm::normalize(glm::cross(across, direction()));
        add_quad(scene, middle + extent * anywhere(), size * across, size * up, material);
    }
}

inline Light point_light(glm::vec3 position, glm::vec3 intensity) {
    Light light;
    light.position = position;
    light.intensity = intensity;
    return light;
}

inline Light spot_light(glm::vec3 position, glm::vec3 direction, glm::vec3 intensity, float inner,
                        float outer) {
    Light light = point_light(position, intensity);
    light.kind = LightKind::spot;
    light.direction = glm::normalize(direction);
    light.inner_cone_angle = inner;
    light.outer_cone_angle = outer;
    return light;
}

inline Light directional_light(glm::vec3 direction, glm::vec3 irradiance) {
    Light light;
    light.kind = LightKind::directional;
    light.direction = glm::normalize(direction);
    light.intensity = irradiance;
    return light;
}

/// A floor of this material, |x|, |z| <= half at y = 0.
inline Scene floor_scene(const Material& material, float half = 10) {
    Scene scene;
    scene.name = "floor";
    add_floor(scene, half, 0, add_material(scene, material));
    return scene;
}

/// A box |x|, |y|, |z| <= 1 seen from its middle.
inline Scene box_scene(const Material& walls) {
    Scene scene;
    scene.name = "box";
    add_box(scene, glm::vec3(-1), glm::vec3(1), add_material(scene, walls), true);
    scene.cameras.push_back(look_at({0, 0, 0}, {0, 0, -1}));
    return scene;
}

/// Fresnel's factor of an index of 1.5, by Schlick's approximation.
inline double varnish_fresnel(double cosine) { return 0.04 + 0.96 * std::pow(1 - cosine, 5); }

/// A room of different Lambertian walls with a point light and an unlit block: much indirect light
/// for little work.
inline Scene room_scene() {
    Scene scene;
    scene.name = "room";
    const glm::vec3 colors[] = {{0.7f, 0.2f, 0.2f}, {0.2f, 0.6f, 0.2f}, {0.7f, 0.7f, 0.7f}};
    for (const glm::vec3& color : colors) {
        add_material(scene, lambertian(color));
    }
    add_box(scene, glm::vec3(-1), glm::vec3(1), 0, true);
    for (std::size_t i = 0; i < scene.triangle_material.size(); ++i) {
        scene.triangle_material[i] = static_cast<std::uint32_t>(i / 4);
    }
    add_box(scene, {-0.6f, -1, -0.7f}, {0.1f, 0.1f, -0.1f}, 2, false);
    scene.lights.push_back(point_light({0.2f, 0.8f, 0.1f}, glm::vec3(1, 0.9f, 0.7f)));
    scene.cameras.push_back(look_at({0.1f, 0.2f, 0.95f}, {0, -0.2f, -1}, 70));
    return scene;
}

/// The room with a stack of 300 white sheets before a wall, 1.5 mm from one to the next.
inline Scene room_with_sheets() {
    Scene scene = room_scene();
    scene.name = "room with sheets";
    const std::uint32_t white = add_material(scene, lambertian(glm::vec3(0.9f)));
    for (int i = 0; i < 300; ++i) {
        const float y = -0.6f + 0.0015f * static_cast<float>(i);
        add_quad(scene, {-0.95f, y, 0.6f}, {0.05f, 0, 0}, {0, 0, -1.2f}, white);
    }
    return scene;
}

/// The scene scaled by `factor`, with its lights adjusted so that the image stays the same.
inline Scene scaled(Scene scene, float factor) {
    for (glm::vec3& p : scene.positions) {
        p *= factor;
    }
    for (Light& light : scene.lights) {
        light.position *= factor;
        light.intensity *= light.kind == LightKind::directional ? 1.0f : factor * factor;
    }
    for (Camera& camera : scene.cameras) {
        camera.position *= factor;
        camera.vertical_extent *= factor;
    }
    return scene;
}

} // namespace argand::testing
