#include "scene/gltf_camera.hpp"

#include "scene/direction.hpp"
#include <cmath>
#include <numbers>

namespace argand {
namespace {

bool is_positive(double value) { return value > 0 && std::isfinite(static_cast<float>(value)); }

/// Places a camera; glTF's cameras look along −Z with +Y up. Returns false if the transform leaves
/// the camera no direction.
bool place(const GltfSource& source, const glm::dmat4& to_world, Camera& camera,
           const std::string& what) {
    camera.position = position_of(source, to_world, what);
    const glm::dvec3 forward = unit_or_zero(-glm::dvec3(to_world[2]));
    const glm::dvec3 right =
        unit_or_zero(glm::cross(forward, unit_or_zero(glm::dvec3(to_world[1]))));
    if (forward == glm::dvec3(0) || right == glm::dvec3(0)) {
        return false;
    }
    camera.forward = glm::vec3(forward);
    camera.right = glm::vec3(right);
    camera.up = glm::vec3(glm::cross(right, forward));
    return true;
}

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

void add_cameras(const GltfSource& source, const std::vector<GltfNode>& nodes, Scene& scene) {
    for (const GltfNode& node : nodes) {
        const tinygltf::Node& carrier = source.model.nodes[std::size_t(node.index)];
        if (carrier.camera < 0) {
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
        if (place(source, node.to_world, camera, what)) {
            scene.cameras.push_back(camera);
        } else {
            add_note(
                scene,
                fmt::format("{} is left out: its node's transform leaves it no direction", what));
        }
    }
}

} // namespace argand
