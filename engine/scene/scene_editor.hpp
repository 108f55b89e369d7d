#pragma once

#include "scene/edits.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace argand {

/// Applies edits to a scene, and takes back those before.
class SceneEditor {
public:
    /// Remembers the scene as it is: without edits.
    explicit SceneEditor(const Scene& scene);

    /// Gives that scene these edits instead of earlier ones, at its moment. The vertices of meshes
    /// stay where they are, as after move_without_vertices(): move_to() or a World places them.
    /// Throws Error if an edited object does not exist, a node cannot move (see
    /// LoadOptions::movable_nodes) or leaves a light or camera no direction; apply the earlier
    /// edits again then.
    void apply(const Edits& edits, Scene& scene);

    const std::vector<MotionNode>& unedited_nodes() const { return nodes_; }

private:
    void restore(Scene& scene) const;
    void edit_nodes(const Edits& edits, Scene& scene) const;
    SolidRanks ranks_at_rest(const Scene& scene) const;

    // As the scene was.
    std::vector<Light> lights_;
    std::vector<Camera> cameras_;
    std::vector<Material> materials_;
    std::optional<SolidRanks> solids_;
    std::optional<glm::vec3> sky_;
    std::optional<Environment> environment_;
    std::vector<MotionNode> nodes_;
    std::vector<MovingLight> moving_lights_;
    std::vector<MovingCamera> moving_cameras_;
    std::vector<MovingMaterial> moving_materials_;

    std::optional<std::pair<SunPosition, Environment>> sun_; ///< that was asked for last
};

} // namespace argand
