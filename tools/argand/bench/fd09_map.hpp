#pragma once

#include "methods/eye_paths.hpp"
#include "methods/render.hpp"
#include "photon/gather.hpp"

#include <functional>

namespace argand {

/// The photons of a picture by the method `footprints`, and what its map is built with.
struct PaperMap {
    RenderSettings render;
    RenderStatistics statistics; ///< of the picture
    DeviceScene scene;
    PhotonWorkspace workspace;
    StoredPhotons stored;
    PhotonMapSettings settings;
    EyeWorkspace eye;
};

/// Renders the picture once, which says how large footprints are, and traces its photons again, all
/// in one pass.
PaperMap trace_paper_map(Device& device, const Scene& scene, const RenderSettings& render);

/// A map that stays as it is when others are built from the same photons, but for its footprints'
/// order.
PhotonMap build(Device& device, PaperMap& paper, std::uint32_t leaf_size);

/// How long the work and all that is recorded before its end take [s]. On a device that is this
/// machine's processor, its time on all cores, which others' work does not change much; else by the
/// clock.
double seconds_of(Device& device, const std::function<void()>& work);

} // namespace argand
