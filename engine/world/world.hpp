#pragma once

#include "plan/surface_use.hpp"
#include "shared/material_record.h"
#include "world/device_scene.hpp"
#include "world/moving_meshes.hpp"
#include "world/texture_table.hpp"
#include "world/tracer_settings.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace argand {

/// A mesh that has moved: its index in Motion::meshes, and the bounding boxes of the vertices that
/// its triangles use.
struct MovedMesh {
    std::size_t mesh = 0;
    Bounds before, after;
};

/// What World::update() did.
struct WorldUpdate {
    std::vector<MovedMesh> moved;      ///< by rising index
    std::size_t turned_meshes = 0;     ///< whose triangles are listed the other way round now
    std::size_t changed_materials = 0; ///< uploaded because a property has changed
    std::uint64_t uploaded_bytes = 0;
    bool refitted = false, rebuilt = false; ///< the tree; at most one of them
};

/// The geometry and materials of a scene on a device, with the tree for rays. Renders share it, and
/// it follows the scene as it moves.
class World {
public:
    /// Uploads the scene and builds the tree. The device places the vertices of meshes that move,
    /// as update() does, so that a moment has the same bits after other moments. Keeps a reference
    /// to the device. Records only, but waits for the device to build a kd-tree. Throws Error if
    /// tracer.tree_memory does not hold one leaf of it.
    World(Device& device, const Scene& scene, const TracerSettings& tracer = {});

    /// Follows the scene to which move_to() or move_without_vertices() has been applied: uploads
    /// the materials that have changed, places the vertices of the meshes if any has moved, by
    /// their nodes' matrices and weights, and refits the tree, or rebuilds it once its cost is 1.15
    /// times that after the last build. A kd-tree is always rebuilt. The scene must be the one of
    /// the constructor but for that. The host does nothing per triangle, unless triangles turn.
    /// Waits for the device if a mesh has moved. Throws Error if a position is not finite.
    WorldUpdate update(const Scene& scene);

    /// The scene as a render with this plan needs it. It shares this world's buffers: update()
    /// changes what it holds. Waits for the device where it has to find areas for a photon map, or
    /// to fetch the boxes of meshes that move, and what those emit that shine.
    DeviceScene on_device(const Scene& scene, const Plan& plan);

    /// What the tree costs rays (traversal_cost()), over what it cost when it was built last.
    double tree_cost() const { return tree_cost_; }

    /// How many updates have changed anything.
    std::uint64_t revision() const { return revision_; }

    Device& device() const { return device_; }
    const TriangleBvh& tree() const { return bvh_; }
    const SurfaceUse& surfaces() const { return surfaces_; }

private:
    void build_tree(const Scene& scene);
    DeviceScene without_areas(const Scene& scene, const Plan& plan);
    void add_textures(const Scene& scene, DeviceScene& on_device);
    void add_sky(const Scene& scene, DeviceScene& on_device);
    void add_casters(const Scene& scene, DeviceScene& on_device);
    void add_areas(const Scene& scene, DeviceScene& on_device);
    bool follow_meshes(const Scene& scene, WorldUpdate& update);
    void upload_turned(const Scene& scene, WorldUpdate& update);
    Bounds box(const Scene& scene);
    const std::vector<std::uint32_t>& shining(const Scene& scene);
    void upload_changed_materials(const Scene& scene, WorldUpdate& update);

    Device& device_;
    TracerSettings tracer_;
    SurfaceUse surfaces_;
    Buffer positions_, triangles_, materials_;
    Buffer normals_;        ///< empty until a plan needs them
    TextureTable textures_; ///< empty until a plan needs it
    Buffer attributes_;     ///< the same
    Buffer sky_;            ///< the same
    std::shared_ptr<const SkyTable> sky_table_;
    std::optional<Environment> environment_; ///< of which the table is
    TriangleBvh bvh_;
    std::uint64_t revision_ = 0;
    std::uint64_t last_material_change_ = 0; ///< see DeviceScene
    std::vector<std::uint64_t> last_moved_;  ///< of each moving mesh, see MeshPlace
    double cost_of_build_ = 0;               ///< see traversal_cost(); 0: not known yet
    double tree_cost_ = 1;

    MovingMeshes meshes_;
    Bounds box_at_rest_;         ///< of what does not move
    std::vector<bool> mirrored_; ///< of each moving mesh, as its triangles were uploaded last
    std::vector<MaterialRecord> uploaded_materials_;

    std::vector<std::uint32_t> shining_;            ///< triangles that emit light
    std::vector<bool> emitting_;                    ///< the materials among which they were found
    std::shared_ptr<const EmissiveParts> emissive_; ///< of them; null: the host makes lights

    /// The areas of all surfaces on which photons may lie.
    struct PhotonAreas {
        float follow_roughness = 0;
        PhotonSurfaces surfaces;
        SampledAreas sampled;
    };
    std::optional<PhotonAreas> areas_; ///< empty until a plan needs them, and after a change
    std::shared_ptr<const CasterTable> casters_; ///< null until a plan needs them
    std::vector<bool> casters_followed_;         ///< the materials among which they were found
};

/// A scene on a device for one render.
inline DeviceScene upload_scene(Device& device, const Scene& scene, const Plan& plan) {
    return World(device, scene).on_device(scene, plan);
}

} // namespace argand
