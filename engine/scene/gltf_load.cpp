#include "scene/framing.hpp"
#include "scene/gltf.hpp"
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

/// Adds a sky and a camera where the file has no light or no camera.
void add_missing_objects(Scene& scene) {
    const bool emissive =
        std::any_of(scene.triangle_material.begin(), scene.triangle_material.end(),
                    [&](std::uint32_t material) { return emits(scene.materials[material]); });
    if (scene.lights.empty() && !emissive) {
        scene.sky = glm::vec3(1);
        add_note(scene, "there is no light: a uniform white sky of radiance 1 is added");
    }
    if (scene.cameras.empty()) {
        scene.cameras.push_back(frame_bounds(bounds(scene)));
        add_note(scene, "there is no camera: one that sees the whole scene is added");
    }
}

} // namespace

Scene load_gltf(const std::filesystem::path& path) {
    Scene scene;
    const GltfSource source = read_gltf_file(path, scene.notes);
    scene.name = one_line(path.filename().string());
    add_extensions(source, scene);
    scene.animations = source.model.animations.size();
    if (scene.animations > 0) {
        add_note(scene, "animations are not supported yet: nodes stay in their rest pose");
    }
    const std::vector<GltfNode> nodes = flatten_nodes(source);
    add_materials(source, scene);
    add_lights(source, nodes, scene);
    add_cameras(source, nodes, scene);
    add_meshes(source, nodes, scene);
    if (scene.triangles.empty()) {
        source.fail(
            "there is nothing to render: it shows no triangle that has an area and can be seen");
    }
    add_missing_objects(scene);
    return scene;
}

} // namespace argand
