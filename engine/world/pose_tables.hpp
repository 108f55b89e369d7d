#pragma once

#include "scene/pose.hpp"
#include "shared/pose_records.h"

#include <cstdint>
#include <vector>

namespace argand {

/// What does not change of the meshes that move: the buffers of pose_vertices.comp and
/// pose_boxes.comp.
struct PoseTables {
    std::vector<MovingVertex> vertices;
    std::vector<VertexJoints> joints; ///< of each vertex of a mesh with a skin
    std::vector<MorphOffset> offsets;
    std::vector<PosedMesh> meshes; ///< in the order of Motion::meshes
    std::vector<PosePart> parts;   ///< a mesh's follow each other
    /// Nodes that carry meshes without skins. Their matrices follow those of the skins' joints.
    std::vector<std::uint32_t> nodes;
};
PoseTables pose_tables(const Scene& scene);

/// What a moment changes.
struct PoseRecords {
    std::vector<PoseMatrix> matrices; ///< of the joints of each skin, then of nodes
    std::vector<MorphWeight> weights; ///< of each mesh's targets
};
PoseRecords pose_records(const Motion& motion, const PoseTables& tables, const Pose& pose);

/// Whether a mesh's matrices or weights differ in any bit.
bool has_moved(const Motion& motion, const PoseTables& tables, std::size_t mesh,
               const PoseRecords& before, const PoseRecords& now);

} // namespace argand
