#pragma once

#include "accel/triangle_bvh.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "shared/camera.h"
#include "shared/scene_records.h"

namespace argand {

/// A scene on the device, as the kernels that shade want it (shaders/comp/scene.glsl).
struct DeviceScene {
    Buffer scene;         ///< one SceneRecord
    Buffer positions;     ///< vec4 per vertex
    Buffer normals;       ///< vec4 per vertex, 0 where the geometric normal serves
    Buffer triangles;     ///< uvec4 per triangle: vertices, material
    Buffer materials;     ///< MaterialRecord
    Buffer lights;        ///< LightRecord: punctual lights, emissive triangles, sky
    Buffer light_choices; ///< LightChoice per light
    Buffer area_sums;     ///< uint per triangle: area of all before it, as a fraction of 2^32
    TriangleBvh bvh;
    SceneRecord record;             ///< the host's copy
    double surface_area = 0;        ///< of all triangles that can be hit; 0 without a photon map
    glm::dvec3 power{0};            ///< of all lights, per channel [lm-like: candela × steradian]
    double emitter_probability = 0; ///< that a choice of light gives an emissive triangle
    Plan plan; ///< what of it kernels need; buffers that they do not need are empty
};

/// Uploads of the scene what the plan needs, and builds its acceleration structure. Records only.
DeviceScene upload_scene(Device& device, const Scene& scene, const Plan& plan);

/// The camera for a picture of this size; the vertical angle is kept whatever the size.
CameraRecord camera_record(const Camera& camera, int width, int height);

/// Alias table (Walker 1977, built after Vose 1991) that chooses i with probability weights[i] /
/// sum.
std::vector<LightChoice> alias_table(const std::vector<double>& weights);

} // namespace argand
