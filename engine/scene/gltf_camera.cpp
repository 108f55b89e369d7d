#include "scene/gltf_camera.hpp"

#include "scene/gltf_shared_keys.hpp"
#include "scene/placement.hpp"
#include <cmath>
#include <numbers>
#include <utility>

namespace argand {
namespace {

bool is_positive(double value) { return value > 0 && std::isfinite(static_cast<float>(value)); }

Camera read_camera(const GltfSource& source, const tinygltf::Camera& from,
                   const std::string& what) {
    Camera camera;
    if (from.type == "orthographic") {
        camera.kind = CameraKind::orthographic;
        const double x =
            // Negative values mirror the image; allowed but discouraged.
            std::abs(from.orthographic.xmag);
        const double y = std::abs(from.orthographic.ymag);
        if (!is_positive(x) || !is_positive(y)) {
            source.fail("{} shows an area of {} by {}; both must be positive", what, 2 * x, 2 * y);
        }
        camera.vertical_extent = static_cast<float>(y);
        camera.aspect = static_cast<float>(x / y);
    } else {
        if (!(from.perspective.yfov > 0) || !(from.perspective.yfov < std::numbers::pi)) {
            source.fail("{} has an angle of view of {}; it must be between 0 and pi", what,
                        from.perspective.yfov);
        }
        camera.vertical_angle = static_cast<float>(from.perspective.yfov);
        camera.aspect = static_cast<float>(from.perspective.aspectRatio);
    }
    if (camera.aspect != 0 && !is_positive(camera.aspect)) {
        source.fail("{} has an aspect ratio of {}; it must be positive", what, camera.aspect);
    }
    return camera;
}

} // namespace

void add_cameras(const GltfSource& source, const std::vector<GltfNode>& nodes,
                 std::vector<CameraKeys> keys, Scene& scene) {
    SharedKeys table(std::move(keys));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const GltfNode& node = nodes[i];
        const tinygltf::Node& carrier = source.model.nodes[std::size_t(node.index)];
        if (carrier.camera < 0 || node.is_instance) {
            continue;
        }
        if (std::size_t(carrier.camera) >= source.model.cameras.size()) {
            source.fail("{} refers to camera {}, which does not exist",
                        label("node", node.index, carrier.name), carrier.camera);
        }
        const tinygltf::Camera& from = source.model.cameras[std::size_t(carrier.camera)];
        const std::string what = label("camera", carrier.camera, from.name);
        Camera camera = read_camera(source, from, what);
        camera.name = one_line(from.name.empty() ? carrier.name : from.name);
        const Camera in_object_space = camera;
        const bool has_direction = place(node.to_world, camera);
        check_position(source, camera.position, what);
        if (!has_direction && !node.moves) {
            add_note(
                scene,
                fmt::format("{} is left out: its node's transform leaves it no direction", what));
            continue;
        }
        const int key_index = table.add(std::size_t(carrier.camera), scene.motion.camera_keys);
        if (node.moves || key_index >= 0) {
            scene.motion.cameras.push_back({.node = static_cast<std::uint32_t>(i),
                                            .index = scene.cameras.size(),
                                            .camera = in_object_space,
                                            .keys = key_index});
        }
        scene.cameras.push_back(camera);
    }
}

} // namespace argand
