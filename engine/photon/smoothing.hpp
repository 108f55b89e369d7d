#pragma once

#include "photon/sort_photons.hpp"

#include <glm/glm.hpp>
#include <span>

namespace argand {

/// Smoothing with which half of the points lie in `on_point` or more footprints of diffusely
/// scattered photons: the counterpart of median_radius for footprints. sorted: with footprints of
/// smoothing 1. points: the fourth component does not count. Looks at a sample of the points and
/// photons. 0 without photons or points. Waits for the device.
double median_smoothing(Device& device, const SortedPhotons& sorted,
                        std::span<const glm::vec4> points, double on_point);

} // namespace argand
