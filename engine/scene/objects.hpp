#pragma once

#include "scene/scene.hpp"

#include <algorithm>
#include <cstddef>
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

/// The end of the triangles of an object, which begin at its first_triangle.
inline std::size_t end_of_object(const Scene& scene, std::size_t object) {
    return object + 1 < scene.objects.size() ? scene.objects[object + 1].first_triangle
                                             : scene.triangles.size();
}

} // namespace argand
