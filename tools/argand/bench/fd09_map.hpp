#pragma once

#include "methods/eye_paths.hpp"
#include "methods/render_result.hpp"
#include "methods/render_settings.hpp"
#include "photon/gather.hpp"

#include <functional>

namespace argand {

/// Photons of an image rendered by the method `footprints`, and the settings of its map.
struct PaperMap {
    RenderSettings render;
    RenderStatistics statistics; ///< of the image
    DeviceScene scene;
    PhotonWorkspace workspace;
    StoredPhotons stored;
    PhotonMapSettings settings;
    EyeWorkspace eye;

    EyePass eye_pass(std::uint32_t samples) const {
        return {.seed = render.seed, .samples = samples, .bounces = render.bounces};
    }
};

/// Renders the image once, which determines the size of footprints, and traces its photons again in
/// one pass.
PaperMap trace_paper_map(Device& device, const Scene& scene, const RenderSettings& render);

/// A map of the photons.
PhotonMap build(Device& device, PaperMap& paper, std::uint32_t leaf_size);

/// Time [s] that the work and the commands recorded by it take. If the device is this machine's
/// processor: CPU time on all cores, which other processes hardly affect; else wall clock time.
double seconds_of(Device& device, const std::function<void()>& work);

} // namespace argand
