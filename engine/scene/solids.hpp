#pragma once

#include "scene/scene.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace argand {

/// The order of the solids that light may pass (shared/solids.h).
struct SolidRanks {
    /// The material of each rank, lowest first: by priority, and of equal priority the larger
    /// volume first, so that an ice cube is in its water, and the water not in the ice.
    std::vector<std::uint32_t> materials;
    /// Of each material of the scene 1 more than its rank; 0: it bounds no solid. A body that is
    /// turned inside out is a cavity, of the solid of the same glass around it, whose rank it has.
    std::vector<std::uint32_t> of_material;
};

SolidRanks solid_ranks(const Scene& scene);

/// Materials of two solids whose surfaces' bounding boxes overlap; of any two if meshes move. Boxes
/// that only touch do not overlap.
std::optional<std::pair<std::uint32_t, std::uint32_t>> overlapping_solids(const Scene& scene);

/// Materials of closed bodies that transmit light but have no thickness, as if of thin walls.
std::vector<std::uint32_t> thin_bodies(const Scene& scene);

} // namespace argand
