#include "scene/framing.hpp"
#include "scene/gltf.hpp"
#include "scene/gltf_animation.hpp"
#include "scene/gltf_camera.hpp"
#include "scene/gltf_extensions.hpp"
#include "scene/gltf_file.hpp"
#include "scene/gltf_light.hpp"
#include "scene/gltf_material.hpp"
#include "scene/gltf_mesh.hpp"
#include "scene/gltf_node.hpp"
#include <algorithm>

namespace argand {
namespace {

/// Adds a sky and a camera where the file has no light or no camera. framed: what the camera sees.
void add_missing_objects(Scene& scene, const Bounds& framed) {
    const bool emissive =
        std::any_of(scene.triangle_material.begin(), scene.triangle_material.end(),
                    [&](std::uint32_t material) { return emits(scene.materials[material]); });
    if (scene.lights.empty() && !emissive) {
        scene.sky = glm::vec3(1);
        add_note(scene, "there is no light: a uniform white sky of radiance 1 is added");
    }
    if (scene.cameras.empty()) {
        scene.cameras.push_back(frame_bounds(framed));
        add_note(scene, "there is no camera: one that sees the whole scene is added");
    }
}

} // namespace

Scene load_gltf(const std::filesystem::path& path, std::optional<double> seconds) {
    Scene scene;
    const GltfSource source = read_gltf_file(path, scene.notes);
    scene.name = one_line(path.filename().string());
    add_extensions(source, scene);
    const std::vector<NodeKeys> keys = read_animations(source, scene);
    if (seconds && scene.animations.empty()) {
        add_note(scene, "there is no animation: the scene is the same at any time");
    }
    const std::vector<GltfNode> nodes = flatten_nodes(source, keys, seconds);
    add_materials(source, scene);
    add_lights(source, nodes, scene);
    add_cameras(source, nodes, scene);
    add_meshes(source, nodes, scene);
    if (scene.triangles.empty()) {
        source.fail(
            "there is nothing to render: it shows no triangle that has an area and can be seen");
    }
    // A camera that is added sees the scene at rest, so that it stands still while objects move.
    const bool moves = seconds && scene.cameras.empty() && !scene.animations.empty();
    add_missing_objects(scene, bounds(moves ? load_gltf(path) : scene));
    return scene;
}

} // namespace argand
