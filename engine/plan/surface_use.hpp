#pragma once

#include "scene/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace argand {

/// How a scene's triangles use its materials. It stays the same as the scene moves.
struct SurfaceUse {
    std::vector<std::uint32_t> materials;  ///< used ones, in the order of their first triangles
    std::vector<std::size_t> triangles;    ///< of each material
    std::optional<std::uint32_t> smoothed; ///< of the first triangle that has vertex normals
    SolidRanks solids;
};

SurfaceUse surface_use(const Scene& scene);

} // namespace argand
