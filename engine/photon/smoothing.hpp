#pragma once

#include "shared/footprint_records.h"
#include "shared/photon_records.h"

#include <glm/glm.hpp>
#include <span>

namespace argand {

/// Smoothing with which half of the points lie in `on_point` or more footprints of diffusely
/// scattered photons: the counterpart of median_radius for footprints. unit: the scale for a
/// smoothing of 1. photons, offsets: as a pass stores them, with empty slots. Looks at a sample of
/// the points and photons. 0 without photons or points.
double median_smoothing(std::span<const PhotonRecord> photons, std::span<const glm::uvec4> offsets,
                        std::span<const glm::vec3> points, const FootprintScale& unit,
                        double on_point);

} // namespace argand
