#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <vector>

namespace argand {

/// The nodes of a scene at one moment, in the order of Motion::nodes.
struct Pose {
    std::vector<glm::dmat4> world_from_node;
    std::vector<std::vector<double>> morph_weights;
};

/// The pose at a time in seconds, finite; none: at rest. Before the first key of a property and
/// after its last one, that key's value counts.
Pose pose_at(const Motion& motion, std::optional<double> seconds);

/// For each joint of a skin the transform to world space of vertices that it alone carries.
std::vector<glm::dmat4> joint_transforms(const Skin& skin, const Pose& pose);

/// Whether each node's transform to world space changes with time, or may be changed by edits.
std::vector<bool> moving_nodes(const Motion& motion);

/// Places the vertices of one moving mesh in the scene, in double precision, and turns its
/// triangles where the node mirrors. Throws Error if a position is not finite.
void place(MovingMesh& mesh, const Pose& pose, Scene& scene);

/// Moves the scene's meshes, lights, cameras and materials to a moment; none: to rest. Nothing else
/// changes. A
/// light that its node leaves no direction is dark, a camera looks along −Z. Values beyond the
/// range of their property are clamped to it. Throws Error if a position is not finite.
void move_to(std::optional<double> seconds, Scene& scene);

/// The same, but the vertices of meshes stay where they are: a World that is told of the moment
/// places them on its device, so that the host does nothing per vertex. Of the meshes, only those
/// change whose triangles turn because their node begins or ceases to mirror.
void move_without_vertices(std::optional<double> seconds, Scene& scene);

} // namespace argand
