#include "ywcyp10_tables.hpp"

#include "bench_scene.hpp"

namespace argand {

Scene make_room_of_spheres(std::uint32_t detail) {
    const BenchScene shape = make_bench_scene(detail);
    Scene scene;
    scene.name = "bench";
    for (const glm::vec4& position : shape.positions) {
        scene.positions.emplace_back(position);
        scene.normals.emplace_back(0);
    }
    for (const glm::uvec4& triangle : shape.triangles) {
        scene.triangles.emplace_back(triangle);
        scene.triangle_material.push_back(0);
    }
    Material material;
    material.metallic = 0;
    material.specular = 0;
    scene.materials.push_back(material);
    constexpr float candela = 100;
    scene.lights.push_back(
        Light{.kind = LightKind::point, .position = shape.light, .intensity = glm::vec3(candela)});
    Camera camera;
    camera.position = shape.eye;
    camera.forward = glm::normalize(shape.target - shape.eye);
    camera.right = glm::normalize(glm::cross(camera.forward, glm::vec3(0, 1, 0)));
    camera.up = glm::cross(camera.right, camera.forward);
    camera.vertical_angle = 1.2f;
    scene.cameras.push_back(camera);
    return scene;
}

} // namespace argand
