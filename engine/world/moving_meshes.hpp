#pragma once

#include "device/device.hpp"
#include "world/pose_tables.hpp"

#include <cstdint>
#include <set>
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

    /// Whether any mesh has one of these materials. materials: a flag for each.
    bool have_any(const std::vector<bool>& materials) const;

private:
    Device& device_;
    PoseTables tables_; ///< without what only the device needs
    PoseRecords pose_;  ///< as it was uploaded last
    Buffer vertices_, joints_, offsets_, meshes_, parts_, matrices_, weights_;
    Buffer part_boxes_, no_normals_;
    std::set<std::uint32_t> materials_; ///< of all meshes
    std::vector<Bounds> boxes_;         ///< of each mesh; empty: not known
};

} // namespace argand
