#pragma once

#include "accel/triangle_bvh.hpp"
#include "kernels/scene_bindings.hpp"
#include "kernels/texture_bindings.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "shared/camera.h"
#include "shared/scene_records.h"
#include "world/aim_tree.hpp"
#include "world/area_table.hpp"
#include "world/caster_table.hpp"
#include "world/emissive_parts.hpp"
#include "world/light_table.hpp"
#include "world/sky_table.hpp"

#include <memory>
#include <vector>

namespace argand {

/// Where a mesh that moves is.
struct MeshPlace {
    Bounds box;                   ///< of the vertices that its triangles use
    std::uint64_t last_moved = 0; ///< World::revision() after it moved last; 0: never
};

/// A scene on a device, in the layout that shading kernels read (shaders/comp/scene_bindings.glsl).
struct DeviceScene {
    Buffer scene;         ///< one SceneRecord
    Buffer positions;     ///< vec4 per vertex
    Buffer normals;       ///< vec4 per vertex, 0 where the file has none
    Buffer triangles;     ///< uvec4 per triangle: vertices, material
    Buffer materials;     ///< MaterialRecord
    Buffer lights;        ///< LightRecord: punctual lights, emissive triangles, sky
    Buffer light_choices; ///< LightChoice per light, for shadow rays and then for photons
    Buffer sky;           ///< SkyTable::words; or not needed
    Buffer aim_nodes;     ///< AimNode of all `aims`, after one that is not used; or not needed
    Buffer attributes;    ///< uvec2: what vertices have for textures, see upload_attributes()
    Buffer textures;      ///< TextureRecord
    Buffer texels;        ///< see TextureTable
    std::uint32_t texture_halvings = 0;        ///< see FittingImages
    std::shared_ptr<const SkyTable> sky_table; ///< the host's copy of `sky`; null: there is none
    TriangleBvh bvh;
    Bounds box;             ///< of the triangles
    SceneRecord record;     ///< the host's copy of `scene`
    LightTable light_table; ///< what the host knows of `lights`, and their emitters
    /// Probabilities with which each emitter is chosen for shadow rays, and for photons.
    std::vector<double> ray_shares, photon_shares;
    std::vector<LightAim> aims;                    ///< how photons from outside are aimed
    PhotonSurfaces photon_surfaces;                ///< empty without a photon map
    double surface_area = 0;                       ///< their area; 0 without a photon map
    std::shared_ptr<const CasterTable> casters;    ///< null without followed paths and a photon map
    std::shared_ptr<const EmissiveParts> emissive; ///< null if the host makes the lights
    SampledAreas areas;
    std::vector<MeshPlace> meshes;          ///< that move, as in Motion::meshes
    std::uint64_t last_material_change = 0; ///< World::revision() after it; 0: never
    Plan plan; ///< which parts kernels need; buffers that they do not need hold one element

    /// Buffers for the member `scene` of a kernel that shades.
    kernels::SceneBindings bindings() const;
    /// Specialization constants for the member `scene` of its constants.
    kernels::SceneConstants constants() const;
    /// The same for the member `texture`, of kernels that evaluate materials.
    kernels::TextureBindings texture_bindings() const;
    kernels::TextureConstants texture_constants() const;
};

/// Memory to bind where a kernel does not read its buffer.
Buffer unneeded(Device& device);

/// Adds the parts of a scene that belong to one render: its lights and how they are chosen. All
/// others but casters and areas must be there (World::on_device()). shining: the triangles that
/// emit light; texels: of those that do by a texture. Waits for the device if there are emissive
/// parts.
void prepare_scene(Device& device, const Scene& scene, const Bounds& box,
                   const std::vector<std::uint32_t>& shining, const TexelTrees& texels,
                   DeviceScene& result);

/// Sets the probabilities with which each emitter is chosen for shadow rays and for photons, and
/// uploads `record` with them. Records only.
void set_light_choices(Device& device, DeviceScene& scene, const std::vector<double>& for_rays,
                       const std::vector<double>& for_photons);

/// Radius of a sphere around a point that contains the scene's bounding sphere.
float radius_around(const glm::vec3& point, const SceneRecord& scene);

/// Bound of the rounding errors of positions, which are interpolated between vertices anywhere in
/// the scene.
float position_error(const SceneRecord& scene);

/// Aims photons from outside, and uploads `lights` with it. Those of lights that are not from
/// outside are left as they are. Records only.
void set_aims(Device& device, DeviceScene& scene, std::vector<LightAim> aims);

/// Aims photons from lights inside the scene at up to four spheres (center, radius), and uploads
/// `record` with them. share: of the photons, for all spheres together. Records only.
void set_targets(Device& device, DeviceScene& scene, std::span<const glm::vec4> spheres,
                 double share);

/// Aims a share of the photons that are scattered outside a sphere (center, radius) at it, and
/// uploads `record` with it. Records only.
void set_view(Device& device, DeviceScene& scene, const glm::vec4& sphere, double share);

/// Sets up to which distance surfaces are nearby, and whether eye paths follow their light; uploads
/// `record` with it. Records only.
void set_near_field(Device& device, DeviceScene& scene, float distance, bool follows);

/// A point or spot light close to surfaces.
struct CloseLight {
    glm::vec3 position{0};
    float close = 0; ///< distance of these surfaces
    float reach = 0; ///< greatest distance at which aimed eye paths pass the light
};

/// Aims a share of the scattered eye paths at what is close to lights, at most 32, and uploads
/// `record` with it. share: of the paths, for all lights together. Records only.
void set_close_lights(Device& device, DeviceScene& scene, std::span<const CloseLight> lights,
                      double share);

/// The camera for a picture of this size in pixels. The vertical angle does not depend on the size.
CameraRecord camera_record(const Camera& camera, int width, int height);

} // namespace argand
