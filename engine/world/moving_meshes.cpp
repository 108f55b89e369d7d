#include "world/moving_meshes.hpp"

#include "base/error.hpp"
#include "kernels/pose_boxes.hpp"
#include "kernels/pose_vertices.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace argand {

namespace {

std::vector<std::uint32_t> materials_of(const Scene& scene, const MovingMesh& mesh) {
    const auto first =
        scene.triangle_material.begin() + static_cast<std::ptrdiff_t>(mesh.first_triangle);
    std::vector<std::uint32_t> materials(first,
                                         first + static_cast<std::ptrdiff_t>(mesh.triangles));
    std::sort(materials.begin(), materials.end());
    materials.erase(std::unique(materials.begin(), materials.end()), materials.end());
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
    materials_.reserve(scene.motion.meshes.size());
    for (const MovingMesh& mesh : scene.motion.meshes) {
        materials_.push_back(materials_of(scene, mesh));
    }
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
    positions_ = positions;
    boxes_.clear();
    is_on_host_.assign(tables_.meshes.size(), false);
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

void MovingMeshes::fetch(std::size_t mesh) {
    const PosedMesh& record = tables_.meshes[mesh];
    const std::vector<glm::vec4> positions =
        download<glm::vec4>(device_, positions_, record.vertices, record.first_vertex);
    std::copy(positions.begin(), positions.end(),
              on_host_->begin() + static_cast<std::ptrdiff_t>(record.first_vertex));
    is_on_host_[mesh] = true;
}

std::shared_ptr<const std::vector<glm::vec3>> MovingMeshes::on_host(const Scene& scene) {
    const auto shines = [&](std::uint32_t material) { return emits(scene.materials[material]); };
    for (std::size_t mesh = 0; mesh < tables_.meshes.size(); ++mesh) {
        if (is_on_host_[mesh] ||
            std::none_of(materials_[mesh].begin(), materials_[mesh].end(), shines)) {
            continue;
        }
        if (!on_host_) {
            on_host_ = std::make_shared<std::vector<glm::vec3>>(scene.positions);
        }
        fetch(mesh);
    }
    return on_host_;
}

} // namespace argand
