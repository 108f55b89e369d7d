#pragma once

#include "methods/render.hpp"
#include "photon/gather.hpp"

#include <span>

namespace argand {

/// How radiance is estimated from a photon map.
enum class Estimator { radius, footprints, nearest };

/// How large the neighbourhoods are in which each pass estimates densities of photons.
struct Bandwidth {
    GatherRadii radii;            ///< of `nearest`: r_max
    std::uint32_t neighbours = 0; ///< k; only of `nearest`
    double smoothing = 0;         ///< only of `footprints`
    double caustic_smoothing = 0; ///< only of `footprints`
    bool caustics = false;        ///< whether there are caustic photons
};

/// The first pass of a picture, from which its bandwidth is learnt.
struct FirstPass {
    const PhotonWorkspace& workspace; ///< holds the pass's photons
    const StoredPhotons& stored;
    std::span<const glm::vec3> queries; ///< points at which the picture queries the photon map
    double passes = 1; ///< of as many photons each, over which the picture averages
};

/// The bandwidth for a picture, from the density of the first pass's photons at its query points.
/// Values that the user has set are kept. Waits for the device.
Bandwidth learn_bandwidth(Device& device, const DeviceScene& scene, const FirstPass& first,
                          const RenderSettings& settings, Estimator estimator);

/// The bandwidth for another number of passes than it was learnt for.
Bandwidth for_passes(const Bandwidth& learnt, double learnt_for, double passes,
                     const RenderSettings& settings);

/// The scale of the footprints of a pass that emits `photons` photons.
FootprintScale footprint_scale(const Bandwidth& bandwidth, const FootprintSettings& settings,
                               double photons, const SceneRecord& scene);

} // namespace argand
