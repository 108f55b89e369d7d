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
    std::unique_ptr<PhotonEstimator> gathers; ///< see PhotonLookup; may be null
    Untaken untaken;

    PhotonLookup lookup() const {
        return {.map = map, .estimator = *estimator, .gathers = gathers.get(), .untaken = untaken};
    }
};

/// How the samples that query one photon map are divided into passes, so that a long render can be
/// saved and interrupted between them. The image has the same bits, however they are divided. The
/// passes of a map follow one another: random numbers of several streams need undivided ones.
struct SampleParts {
    std::uint64_t count = 1;   ///< passes
    std::uint32_t samples = 1; ///< of each but a last, smaller one, per pixel
};

/// Parts of `samples` samples a pixel. They have RenderSettings::samples_per_pass at most, but not
/// fewer than are traced together. Undivided with a budget, and where RenderSettings::least_passes
/// asks for several moments or for passes that are alike.
SampleParts divide_samples(const RenderSettings& settings, const EyeWorkspace& workspace,
                           std::uint32_t samples);

/// The pass of this index among the parts of `whole`.
EyePass part_of(const EyePass& whole, const SampleParts& parts, std::uint64_t part);

} // namespace argand
