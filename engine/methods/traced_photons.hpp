#pragma once

#include "methods/bandwidth.hpp"
#include "methods/method.hpp"
#include "photon/photon_map.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace argand {

/// The unit of the fixed-point flux sums for passes of this many photons, or more. A light may be
/// switched on while a shutter is open.
double flux_unit_for(const DeviceScene& scene, std::uint64_t photons);

/// The sums of flux, for reports. unit: of the fixed-point sums.
FluxSums flux_of(const std::vector<std::int64_t>& words, double unit);

/// Seed of a pass's area samples, which differs for every seed and pass of an image.
std::uint32_t area_seed(const PassNumbers& numbers);

/// Of photons that were aimed at what is in view, many carry little flux and a few much. The noise
/// of n of them is that of (Σ flux)² / Σ flux² photons of equal flux. Surfaces that face away from
/// the camera do not count, though a mirror may show them: a sun may shine on the outer side of a
/// room's walls. Waits for the device.
Evenness evenness_in_view(RenderContext& context, const PhotonWorkspace& workspace,
                          const StoredPhotons& stored);

/// Photons stored in view per photon emitted, see photons_in_view.hpp. Waits for the device.
double in_view_per_emitted(RenderContext& context, const PhotonWorkspace& workspace,
                           const StoredPhotons& stored, std::span<const glm::vec4> queries);

} // namespace argand
