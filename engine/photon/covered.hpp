#pragma once

#include "photon/photon_map.hpp"

#include <cstdint>

namespace argand {

/// The part of space in which area samples surround every query, of that in which they lie: a disc
/// at its edge would lack some of them.
SampledPart corrected_part(const SampledPart& sampled);

// Surfaces that lie lower than `height` over a place cover it, unless light passes through them.
// Hardly any light reaches such a place, or other light than the surface around it has: that in the
// gap behind a panel, or between the slats of a blind. So neither its area nor its photons count
// for an estimate that lies outside. Short rays against the normals find them.

/// Takes the area of covered sides from area samples, which lie behind the stored slots.
void drop_covered_areas(Device& device, const DeviceScene& scene, PhotonWorkspace& workspace,
                        std::uint32_t samples, double height);

/// Drops covered photons, but for caustic ones and outside the part in which area samples surround
/// every query. slots: records in use.
void drop_covered_photons(Device& device, const DeviceScene& scene, PhotonWorkspace& workspace,
                          std::uint64_t slots, double height, const SampledPart& corrected);

// Surfaces go on behind a wall that stands on them, and inside a body. Neither the light of the
// room behind the wall nor the dark area inside counts for what is in view. A place near points in
// view counts only if a ray along the surface reaches one of the nearest: it is linked to the view.

/// Takes the area of sides that are not linked from area samples, which lie behind the stored
/// slots. corrected: the part in which area samples surround every query. Nothing is dropped
/// outside.
void drop_unlinked_areas(Device& device, const DeviceScene& scene, PhotonWorkspace& workspace,
                         std::uint32_t samples, const ViewPoints& view,
                         const SampledPart& corrected);

/// Drops photons that are not linked, but for caustic ones, in cells in which some area was not. To
/// be called after drop_unlinked_areas(). slots: records in use.
void drop_unlinked_photons(Device& device, const DeviceScene& scene, PhotonWorkspace& workspace,
                           std::uint64_t slots, const ViewPoints& view,
                           const SampledPart& corrected);

} // namespace argand
