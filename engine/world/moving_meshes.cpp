#include "world/moving_meshes.hpp"

#include "base/error.hpp"
#include "kernels/pose_boxes.hpp"
#include "kernels/pose_vertices.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace argand {

namespace {

/// The materials of moving meshes, each once.
std::set<std::uint32_t> materials_of(const Scene& scene) {
    std::set<std::uint32_t> materials;
    for (const MovingMesh& mesh : scene.motion.meshes) {
        const auto first =
            scene.triangle_material.begin() + static_cast<std::ptrdiff_t>(mesh.first_triangle);
        materials.insert(first, first + static_cast<std::ptrdiff_t>(mesh.triangles));
    }
    return materials;
}

template <class T>
std::uint64_t upload_all(Device& device, const Buffer& to, const std::vector<T>& elements) {
    if (!elements.empty()) {
        device.upload(to, 0, std::as_bytes(std::span(elements)));
    }
    return elements.size() * sizeof(T);
}

} // namespace

MovingMeshes::MovingMeshes(Device& device, const Scene& scene)
    : device_(device), tables_(pose_tables(scene)) {
    if (empty()) {
        return;
    }
    const StageScope stage(device, "upload scene");
    pose_ = pose_of(scene);
    vertices_ = upload(device, "moving vertices", tables_.vertices);
    joints_ = upload(device, "vertex joints", tables_.joints);
    offsets_ = upload(device, "morph offsets", tables_.offsets);
    meshes_ = upload(device, "moving meshes", tables_.meshes);
    parts_ = upload(device, "parts of moving meshes", tables_.parts);
    matrices_ = upload(device, "pose matrices", pose_.matrices);
    weights_ = upload(device, "morph weights", pose_.weights);
    part_boxes_ = device.allocate("boxes of moving parts",
                                  std::max<std::size_t>(tables_.parts.size(), 1) * sizeof(PoseBox));
    no_normals_ = device.allocate("not needed", sizeof(glm::vec4));
    materials_ = materials_of(scene);
    // Only the device needs them.
    tables_.vertices = {};
    tables_.joints = {};
    tables_.offsets = {};
}

PoseRecords MovingMeshes::pose_of(const Scene& scene) const {
    return pose_records(scene.motion, tables_, pose_at(scene.motion, scene.seconds));
}

std::vector<std::size_t> MovingMeshes::moved_by(const Scene& scene, const PoseRecords& pose) const {
    std::vector<std::size_t> moved;
    moved.reserve(tables_.meshes.size());
    for (std::size_t mesh = 0; mesh < tables_.meshes.size(); ++mesh) {
        if (has_moved(scene.motion, tables_, mesh, pose_, pose)) {
            moved.push_back(mesh);
        }
    }
    return moved;
}

std::uint64_t MovingMeshes::upload_pose(PoseRecords pose) {
    pose_ = std::move(pose);
    return upload_all(device_, matrices_, pose_.matrices) +
           upload_all(device_, weights_, pose_.weights);
}

void MovingMeshes::place(const Buffer& positions, const Buffer* normals) {
    const PosedMesh& last = tables_.meshes.back();
    const std::uint32_t count = last.first_moving_vertex + last.vertices;
    dispatch(device_,
             kernels::pose_vertices{.vertices = vertices_,
                                    .joints = joints_,
                                    .offsets = offsets_,
                                    .meshes = meshes_,
                                    .matrices = matrices_,
                                    .weights = weights_,
                                    .positions = positions,
                                    .normals = normals ? *normals : no_normals_,
                                    .params = {count, normals ? 1u : 0u}},
             count);
    boxes_.clear();
    const auto parts = static_cast<std::uint32_t>(tables_.parts.size());
    dispatch(device_,
             kernels::pose_boxes{.parts = parts_,
                                 .vertices = vertices_,
                                 .positions = positions,
                                 .boxes = part_boxes_,
                                 .params = {parts}},
             parts);
}

const std::vector<Bounds>& MovingMeshes::boxes(const Scene& scene) {
    if (!boxes_.empty()) {
        return boxes_;
    }
    const std::vector<PoseBox> parts =
        download<PoseBox>(device_, part_boxes_, tables_.parts.size());
    boxes_.assign(tables_.meshes.size(), Bounds());
    const MovingMesh* not_finite = nullptr;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::uint32_t mesh = tables_.parts[i].mesh;
        const PoseBox& part = parts[i];
        if (part.not_finite > 0) {
            not_finite = &scene.motion.meshes[mesh];
        }
        Bounds& box = boxes_[mesh];
        box.low = glm::min(box.low, {part.low_x, part.low_y, part.low_z});
        box.high = glm::max(box.high, {part.high_x, part.high_y, part.high_z});
    }
    // A later moment may be finite again, and asks for these boxes first.
    if (not_finite) {
        fail("posing '{}': a vertex of {} has a position that is not finite in world space",
             scene.name, not_finite->name);
    }
    return boxes_;
}

bool MovingMeshes::have_any(const std::vector<bool>& materials) const {
    return std::any_of(materials_.begin(), materials_.end(),
                       [&](std::uint32_t material) { return materials[material]; });
}

} // namespace argand
