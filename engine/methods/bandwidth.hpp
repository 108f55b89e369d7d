#pragma once

#include "methods/render.hpp"
#include "photon/gather.hpp"

#include <span>

namespace argand {

/// How radiance is estimated from the map.
enum class Estimator { radius, footprints, nearest };

/// Over how large a neighbourhood densities of photons are estimated, in each pass.
struct Bandwidth {
    GatherRadii radii;            ///< of `nearest`: r_max
    std::uint32_t neighbours = 0; ///< k; only of `nearest`
    double smoothing = 0;         ///< only of `footprints`
    double caustic_smoothing = 0; ///< only of `footprints`
    bool caustics = false;        ///< whether there are caustic photons
};

/// What is learnt from the photons of a picture's first pass and the points at which the picture
/// asks for them, for so many passes of as many photons; what the user has set is as set. Waits for
/// the device.
Bandwidth learn_bandwidth(Device& device, const DeviceScene& scene,
                          const PhotonWorkspace& workspace, const StoredPhotons& stored,
                          std::span<const glm::vec3> queries, const RenderSettings& settings,
                          Estimator estimator, double passes);

/// The same for another number of passes.
Bandwidth for_passes(const Bandwidth& learnt, double learnt_for, double passes,
                     const RenderSettings& settings);

/// Of a pass of so many photons.
FootprintScale footprint_scale(const Bandwidth& bandwidth, const FootprintSettings& settings,
                               double photons, const SceneRecord& scene);

} // namespace argand
