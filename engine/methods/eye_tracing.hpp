#pragma once

#include "methods/eye_paths.hpp"

#include <vector>

namespace argand {

/// Light that a path received by a shadow ray.
struct FoundLight {
    std::uint32_t light = 0; ///< index among the scene's lights
    std::uint32_t pixel = 0; ///< index among the batch's
    bool indirect = false;   ///< the light is reflected again before it reaches the eye
    double radiance = 0;     ///< that it adds to the path's sample, as the sum of the channels
    glm::vec3 point{0};      ///< where it arrives
    glm::vec3 direction{0};  ///< unit, in which it travels
};

/// Traces the paths of a batch to their end. All paths that wait at some vertex have their queries
/// answered together: few dispatches of many queries keep a GPU busy, and more of them share an
/// answer. Adds the lights that shadow rays find to `found`, if there is such a list.
void trace_paths(Device& device, const DeviceScene& scene, EyeWorkspace& workspace,
                 const Buffer& camera, const EyeBatch& batch, const PhotonLookup* lookup,
                 std::vector<FoundLight>* found = nullptr);

} // namespace argand
