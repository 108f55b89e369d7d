#pragma once

#include "methods/eye_paths.hpp"
#include "photon/photon_map.hpp"

#include <cstdint>
#include <memory>

namespace argand {

/// Device memory for light paths: photons that are traced together, and what they bring to pixels.
/// The photons' workspace refers to it.
struct LightPathWorkspace {
    PhotonWorkspace photons;
    Buffer paths;       ///< LightPathRecord per slot
    Buffer shadow_rays; ///< RayRecord per slot, to the eye
    Buffer occluded;    ///< uint per slot
    Buffer splats;      ///< SplatRecord per slot
    Buffer keys, slots; ///< uint per slot: splats in the order of their pixels
};

/// Memory for passes of this many photons.
std::unique_ptr<LightPathWorkspace> make_light_path_workspace(Device& device,
                                                              std::uint64_t photons);

/// Traces photons, connects their hits from the second one on with the eye, and adds what they
/// bring to the film, for the pass's samples of each pixel. The weights are those of eye paths that
/// have this number of photons as EyePass::light_paths. flux_unit: as in trace_photons().
/// photons_per_sample: of the pass, for each sample of a pixel. Waits for the device.
void trace_light_paths(Device& device, const DeviceScene& scene, LightPathWorkspace& workspace,
                       EyeWorkspace& eye, const PhotonPass& pass, float flux_unit,
                       double photons_per_sample, std::uint32_t samples);

} // namespace argand
