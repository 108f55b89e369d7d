#pragma once

#include "accel/triangle_bvh.hpp"
#include "kernels/scene_bindings.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "shared/camera.h"
#include "shared/scene_records.h"

namespace argand {

/// A scene on a device, in the layout that shading kernels read (shaders/comp/scene_bindings.glsl).
struct DeviceScene {
    Buffer scene;         ///< one SceneRecord
    Buffer positions;     ///< vec4 per vertex
    Buffer normals;       ///< vec4 per vertex, 0 where the file has none
    Buffer triangles;     ///< uvec4 per triangle: vertices, material
    Buffer materials;     ///< MaterialRecord
    Buffer lights;        ///< LightRecord: punctual lights, emissive triangles, sky
    Buffer light_choices; ///< LightChoice per light
    Buffer area_sums;     ///< AreaSumRecord per triangle, along a space-filling curve
    TriangleBvh bvh;
    SceneRecord record;      ///< the host's copy of `scene`
    double surface_area = 0; ///< of all triangles that store photons; 0 without a photon map
    glm::dvec3 power{0};     ///< of all lights, per channel [candela × steradian]
    Plan plan; ///< which parts kernels need; buffers that they do not need hold one element

    /// Buffers for the member `scene` of a kernel that shades.
    kernels::SceneBindings bindings() const;
    /// Specialization constants for the member `scene` of its constants.
    kernels::SceneConstants constants() const;
};

/// Uploads the parts of the scene that the plan needs, and builds its acceleration structure.
/// Records only.
DeviceScene upload_scene(Device& device, const Scene& scene, const Plan& plan);

/// The camera for a picture of this size in pixels. The vertical angle does not depend on the size.
CameraRecord camera_record(const Camera& camera, int width, int height);

/// Alias table (Walker 1977, built as by Vose 1991) for choosing i with probability weights[i] /
/// sum; all are equally probable if the sum is 0.
std::vector<LightChoice> alias_table(const std::vector<double>& weights);

} // namespace argand
