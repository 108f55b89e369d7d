#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>

namespace argand {

enum class LightKind : std::uint32_t { point, spot, directional };

/// KHR_lights_punctual in world space.
struct Light {
    std::string name;
    LightKind kind = LightKind::point;
    glm::vec3 position{0};         ///< point, spot
    glm::vec3 direction{0, 0, -1}; ///< unit, direction in which light travels: spot, directional
    glm::vec3 intensity{1};        ///< colour × intensity: [cd] point and spot, [lux] directional
    float inner_cone_angle = 0;    ///< [rad] spot
    float outer_cone_angle = 0.7853982f; ///< [rad] spot

    bool operator==(const Light&) const = default;
};

} // namespace argand
