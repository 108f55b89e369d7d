#pragma once

#include "photon/sort_photons.hpp"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace argand {

/// Photons that a disc of density estimation should hold if `photons_stored` are stored in all.
/// Bias grows as r², variance falls as 1 / (n r²): their balance is r ∝ n^(−1/6) (Silverman 1986,
/// §4.3, in two dimensions). Caustics have edges, and are better with fewer photons.
double photons_in_disc(double photons_stored, bool caustic = false);

/// Radius within which half of the points have `in_disc` or more photons, in the scene's units: the
/// median distance to the `in_disc`-th nearest photon. Looks at a sample of the photons that are
/// near a point in their order. points: the fourth component does not count. 0 without photons or
/// points. Waits for the device.
double median_radius(Device& device, const SortedPhotons& sorted, std::span<const glm::vec4> points,
                     double in_disc);

/// The same for caustic photons alone, at the places of about a thousand of them, because that is
/// where caustics are.
double median_caustic_radius(Device& device, const SortedPhotons& sorted, double in_disc);

/// The least share of the area samples that discs want with which estimates are still corrected.
inline constexpr double least_area_share = 0.25;

/// Number of samples of surfaces of this area from which to estimate how much of a disc of this
/// radius lies on them: `share` (at least the least) of 90 in a disc, or down to the least share if
/// a map has no room for more; 0 if it has no room for these.
std::uint64_t area_samples(double surface_area, double radius, double share = 1);

/// Whether a map has room for that share.
bool has_room_for_area_samples(double surface_area, double radius, double share);

} // namespace argand
