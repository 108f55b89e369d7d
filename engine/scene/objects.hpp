#pragma once

#include "scene/scene.hpp"

#include <algorithm>
#include <cstdint>

namespace argand {

/// The number of the object that a triangle belongs to: 1 + the index in the file of the node that
/// shows it; 0 in a scene that has no objects.
inline std::uint32_t object_id(const Scene& scene, std::uint32_t triangle) {
    const auto behind = std::upper_bound(
        scene.objects.begin(), scene.objects.end(), triangle,
        [](std::uint32_t t, const SceneObject& object) { return t < object.first_triangle; });
    return behind == scene.objects.begin() ? 0 : std::prev(behind)->node + 1;
}

} // namespace argand
