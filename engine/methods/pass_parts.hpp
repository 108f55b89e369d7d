#pragma once

#include "methods/eye_paths.hpp"
#include "methods/render_settings.hpp"
#include "photon/estimator.hpp"
#include "photon/photon_map.hpp"

#include <cstdint>
#include <memory>

namespace argand {

/// A photon map, and what answers its queries.
struct MadeMap {
    PhotonMap map;
    std::unique_ptr<PhotonEstimator> estimator;

    PhotonLookup lookup() const { return {.map = map, .estimator = *estimator}; }
};

/// How the eye paths that query one photon map are divided into passes, so that a long render can
/// be saved and interrupted between them. The image has the same bits, however it is divided.
struct PassParts {
    std::uint64_t count = 1;
    std::uint32_t samples = 1; ///< of each part but a last, smaller one, per pixel
};

/// Parts of `samples` samples a pixel. They have RenderSettings::samples_per_pass at most, but not
/// fewer than are traced together. One part where passes must be alike: with a budget, and where
/// their variance is that of the image.
PassParts divide_pass(const RenderSettings& settings, const EyeWorkspace& workspace,
                      std::uint32_t samples);

/// The samples of a part of a pass.
EyePass part_of(const EyePass& whole, const PassParts& parts, std::uint64_t part);

} // namespace argand
