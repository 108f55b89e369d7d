#pragma once

#include "shared/material_record.h"
#include "world/device_scene.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace argand {

/// What World::update() did.
struct WorldUpdate {
    std::size_t moved_meshes = 0;
    std::size_t changed_materials = 0; ///< uploaded because a property has changed
    std::uint64_t uploaded_bytes = 0;
    bool refitted = false, rebuilt = false; ///< the tree; at most one of them
};

/// The geometry and materials of a scene on a device, with the tree for rays. Renders share it, and
/// it follows the scene as it moves.
class World {
public:
    /// Uploads the scene and builds the tree. Keeps a reference to the device. Records only.
    World(Device& device, const Scene& scene);

    /// Follows the scene to which move_to() has been applied: uploads the materials that have
    /// changed and the meshes that have moved, and refits the tree, or rebuilds it once its cost is
    /// 1.3 times that after the last build. The scene must be the one of the constructor but for
    /// that. Waits for the device if a mesh has moved.
    WorldUpdate update(const Scene& scene);

    /// The scene as a render with this plan needs it. It shares this world's buffers: update()
    /// changes what it holds. Records only.
    DeviceScene on_device(const Scene& scene, const Plan& plan);

    /// How many updates have changed anything.
    std::uint64_t revision() const { return revision_; }

    Device& device() const { return device_; }

private:
    void build_tree(const Scene& scene);
    void add_areas(const Scene& scene, DeviceScene& on_device);
    bool upload_moved(const Scene& scene, std::size_t mesh, WorldUpdate& update);
    void upload_changed_materials(const Scene& scene, WorldUpdate& update);

    Device& device_;
    Buffer positions_, triangles_, materials_;
    Buffer normals_; ///< empty until a plan needs them
    TriangleBvh bvh_;
    std::uint64_t revision_ = 0;
    double cost_of_build_ = 0; ///< see traversal_cost(); 0: not known yet

    /// A moving mesh as it was uploaded last.
    struct Uploaded {
        std::vector<glm::vec3> positions, normals;
        bool mirrored = false;
    };
    std::vector<Uploaded> uploaded_;
    std::vector<MaterialRecord> uploaded_materials_;

    /// The areas of all surfaces on which photons may lie.
    struct PhotonAreas {
        float follow_roughness = 0;
        std::shared_ptr<const std::vector<double>> by_triangle;
        SampledAreas sampled;
    };
    std::optional<PhotonAreas> areas_; ///< empty until a plan needs them, and after a change
};

/// A scene on a device for one render. Records only.
inline DeviceScene upload_scene(Device& device, const Scene& scene, const Plan& plan) {
    return World(device, scene).on_device(scene, plan);
}

} // namespace argand
