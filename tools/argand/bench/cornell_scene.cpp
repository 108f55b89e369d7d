#include "cornell_scene.hpp"

namespace argand {

namespace {

std::uint32_t add_material(Scene& scene, glm::vec3 color, glm::vec3 emission = glm::vec3(0)) {
    Material material;
    material.base_color = color;
    material.metallic = 0;
    material.specular = 0;
    material.emission = emission;
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

/// A parallelogram whose front faces along u × v.
void add_quad(Scene& scene, std::uint32_t material, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const glm::vec3& position : {corner, corner + u, corner + u + v, corner + v}) {
        scene.positions.push_back(position);
        scene.normals.emplace_back(0);
    }
    scene.triangles.emplace_back(first, first + 1, first + 2);
    scene.triangles.emplace_back(first, first + 2, first + 3);
    scene.triangle_material.insert(scene.triangle_material.end(), 2, material);
}

/// A closed box standing on the floor, rotated around the vertical.
void add_box(Scene& scene, std::uint32_t material, glm::vec3 corner, glm::vec3 u, glm::vec3 v,
             float height) {
    const glm::vec3 up(0, height, 0);
    add_quad(scene, material, corner, up, u);
    add_quad(scene, material, corner + u, up, v);
    add_quad(scene, material, corner + u + v, up, -u);
    add_quad(scene, material, corner + v, up, -v);
    add_quad(scene, material, corner + up, v, u);
}

} // namespace

Scene cornell_scene() {
    Scene scene;
    scene.name = "cornell";
    const std::uint32_t white = add_material(scene, glm::vec3(0.73f));
    const std::uint32_t red = add_material(scene, {0.63f, 0.06f, 0.05f});
    const std::uint32_t green = add_material(scene, {0.14f, 0.45f, 0.09f});
    const std::uint32_t light = add_material(scene, glm::vec3(0.73f), glm::vec3(15));
    add_quad(scene, white, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    add_quad(scene, white, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2});
    add_quad(scene, white, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0});
    add_quad(scene, red, {-1, 0, 1}, {0, 0, -2}, {0, 2, 0});
    add_quad(scene, green, {1, 0, -1}, {0, 0, 2}, {0, 2, 0});
    add_quad(scene, light, {-0.25f, 1.98f, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f});
    add_box(scene, white, {-0.7f, 0.001f, -0.2f}, {0.55f, 0, -0.2f}, {-0.2f, 0, -0.5f}, 1.2f);
    add_box(scene, white, {0.1f, 0.001f, 0.5f}, {0.5f, 0, 0.2f}, {0.2f, 0, -0.5f}, 0.6f);
    Camera camera;
    camera.position = {0, 1, 3.8f};
    camera.vertical_angle = 0.69f;
    scene.cameras.push_back(camera);
    return scene;
}

} // namespace argand
