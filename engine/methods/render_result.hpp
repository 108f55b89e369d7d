#pragma once

#include "image/image.hpp"
#include "shared/footprint_records.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace argand {

/// Flux by channel in units of FluxSums::unit: emitted = absorbed + escaped + cut +
/// lost, exactly.
struct FluxSums {
    std::array<std::int64_t, 3> emitted{}, absorbed{}, escaped{}, cut{}, lost{};
    double unit = 0;
};

/// What happened while rendering.
struct RenderStatistics {
    std::uint64_t samples = 0; ///< eye paths per pixel that were traced
    std::uint64_t passes = 0;
    std::uint64_t photons_emitted = 0;
    std::uint64_t photons_stored = 0;
    /// Of these, about so many lie on surfaces that the picture shows directly, at the share of a
    /// sample of the first pass.
    double photons_in_view = 0;
    // Of the last pass; 0 where the method has no such thing.
    double radius = 0;
    double caustic_radius = 0; ///< radius for caustic photons
    std::uint32_t neighbours = 0;
    std::uint32_t caustic_neighbours = 0;
    double smoothing = 0;
    double mean_footprints = 0;  ///< footprints on a point, if they were spread evenly
    double least_coverage = 0;   ///< of estimates that are taken; 0: all are
    double near_field = 0;       ///< distance within which eye paths follow light; 0: none
    std::uint32_t leaf_size = 0; ///< maximum number of photons in a leaf of the map
    std::optional<FootprintScale> footprint_scale; ///< none: photons are points
    std::uint64_t non_finite = 0; ///< samples left out because they were not finite
    FluxSums flux;
    glm::ivec2 reduced_sky{0};          ///< size of the sky's picture; 0: it is not reduced
    std::uint32_t texture_halvings = 0; ///< of the largest textures, which the device cannot hold
    bool interrupted = false;           ///< pixels hold the samples that were finished, maybe none
    /// What a method counts beside all this, by a name that is a key of JSON.
    std::map<std::string, double> own;
};

struct RenderResult {
    std::vector<Layer> layers; ///< "" (the whole image), "direct", "indirect", "caustic"
    RenderStatistics statistics;
};

} // namespace argand
