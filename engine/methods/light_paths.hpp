#pragma once

#include "methods/eye_paths.hpp"
#include "photon/photon_map.hpp"

#include <cstdint>

namespace argand {

/// Device memory for light paths: photons that are traced together, and what they bring to pixels.
struct LightPathWorkspace {
    PhotonWorkspace photons;
    Buffer paths;       ///< LightPathRecord per slot
    Buffer shadow_rays; ///< RayRecord per slot, to the eye
    Buffer occluded;    ///< uint per slot
    Buffer splats;      ///< SplatRecord per slot
    Buffer keys, slots; ///< uint per slot: splats in the order of their pixels
};

/// Memory for passes of this many photons.
LightPathWorkspace make_light_path_workspace(Device& device, std::uint64_t photons);

/// The samples of each pixel beside which a pass traces light paths.
struct LightPathSamples {
    double photons = 0;     ///< EyePass::light_paths of the samples
    std::uint32_t last = 1; ///< number of the pass's last one: mip levels are those of its paths
    std::uint32_t finished = 1; ///< samples for which the light paths count
};

/// Traces photons, connects their hits from the second one on with the eye, and adds what they
/// bring to the film. flux_unit: as in trace_photons(). Waits for the device.
void trace_light_paths(Device& device, const DeviceScene& scene, LightPathWorkspace& workspace,
                       EyeWorkspace& eye, const PhotonPass& pass, float flux_unit,
                       const LightPathSamples& samples);

} // namespace argand
