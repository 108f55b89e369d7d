#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>

namespace argand {

enum class CameraKind : std::uint32_t { perspective, orthographic };

/// A camera in world space; right, up and forward are orthonormal.
struct Camera {
    std::string name;
    CameraKind kind = CameraKind::perspective;
    glm::vec3 position{0};
    glm::vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
    float vertical_angle = 0.7853982f; ///< [rad], perspective: full vertical angle of view
    float vertical_extent = 1;         ///< orthographic: half the visible height (glTF ymag)
    float aspect = 0;                  ///< width / height as the file states it; 0: not stated

    bool operator==(const Camera&) const = default;
};

} // namespace argand
