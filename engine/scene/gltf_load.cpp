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

/// Bounds of the scene at rest, or of `posed` if nothing can be seen at rest.
Bounds bounds_at_rest(const GltfSource& source, const std::vector<NodeKeys>& keys,
                      const Scene& posed) {
    Scene rest;
    rest.materials = posed.materials;
    add_meshes(source, flatten_nodes(source, keys, {}), rest);
    return bounds(rest.triangles.empty() ? posed : rest);
}

/// Adds a sky where the file has no light.
void add_missing_light(Scene& scene) {
    const bool emissive =
        std::any_of(scene.triangle_material.begin(), scene.triangle_material.end(),
                    [&](std::uint32_t material) { return emits(scene.materials[material]); });
    if (scene.lights.empty() && !emissive) {
        scene.sky = glm::vec3(1);
        add_note(scene, "there is no light: a uniform white sky of radiance 1 is added");
    }
}

} // namespace

Scene load_gltf(const std::filesystem::path& path, std::optional<double> seconds) {
    Scene scene;
    const GltfSource source = read_gltf_file(path, scene.notes);
    scene.name = one_line(path.filename().string());
    scene.seconds = seconds;
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
    add_missing_light(scene);
    // A camera that is added sees the scene at rest, so that it stands still while objects move.
    if (scene.cameras.empty()) {
        scene.cameras.push_back(
            frame_bounds(seconds ? bounds_at_rest(source, keys, scene) : bounds(scene)));
        add_note(scene, seconds
                            ? "there is no camera: one that sees the whole scene at rest is added"
                            : "there is no camera: one that sees the whole scene is added");
    }
    return scene;
}

} // namespace argand
