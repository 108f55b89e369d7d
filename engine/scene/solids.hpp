#pragma once

#include "scene/scene.hpp"

#include <cstdint>
#include <vector>

namespace argand {

/// Ranks of the scene's solids, from where they are now.
SolidRanks solid_ranks(const Scene& scene);

/// The ranks that the scene has; those from where solids are now if it has none.
SolidRanks known_solid_ranks(const Scene& scene);

/// Materials of closed bodies that transmit light but have no thickness, as if of thin walls.
std::vector<std::uint32_t> thin_bodies(const Scene& scene);

} // namespace argand
