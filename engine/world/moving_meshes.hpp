#pragma once

#include "device/device.hpp"
#include "world/pose_tables.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace argand {

/// The meshes of a scene that move, on a device, which places their vertices. Their object space is
/// uploaded once; a moment takes matrices and morph weights only.
class MovingMeshes {
public:
    /// Uploads the meshes, and their pose at the scene's moment. Records only. Keeps a reference to
    /// the device.
    MovingMeshes(Device& device, const Scene& scene);

    bool empty() const { return tables_.meshes.empty(); }

    /// The pose at the scene's moment.
    PoseRecords pose_of(const Scene& scene) const;

    /// The meshes that this pose moves from where they are, by rising index.
    std::vector<std::size_t> moved_by(const Scene& scene, const PoseRecords& pose) const;

    /// Uploads a pose. Returns the number of bytes. Records only.
    std::uint64_t upload_pose(PoseRecords pose);

    /// Places the vertices: positions and, unless null, normals; vec4 per vertex of the scene. Not
    /// if there is no mesh. Records only.
    void place(const Buffer& positions, const Buffer* normals);

    /// Bounding box of the vertices that each mesh's triangles use. Waits for the device if they
    /// were placed since the last call. Throws Error if a position is not finite.
    const std::vector<Bounds>& boxes(const Scene& scene);

    /// Positions on the host of all the scene's vertices; null if no mesh that moves has shone yet.
    /// Of moving meshes only those that shine are up to date. Waits for the device if it has to
    /// fetch any.
    std::shared_ptr<const std::vector<glm::vec3>> on_host(const Scene& scene);

private:
    void fetch(std::size_t mesh);

    Device& device_;
    PoseTables tables_; ///< without what only the device needs
    PoseRecords pose_;  ///< as it was uploaded last
    Buffer vertices_, joints_, offsets_, meshes_, parts_, matrices_, weights_;
    Buffer part_boxes_, no_normals_;
    Buffer positions_;                                  ///< where the vertices were placed
    std::vector<std::vector<std::uint32_t>> materials_; ///< of each mesh
    std::vector<Bounds> boxes_;                         ///< of each mesh; empty: not known
    std::shared_ptr<std::vector<glm::vec3>> on_host_;   ///< null until it is asked for
    std::vector<bool> is_on_host_;                      ///< each mesh, as it is placed
};

} // namespace argand
