#pragma once

#include "base/archive.hpp"
#include "methods/render_result.hpp"
#include "methods/render_settings.hpp"
#include "photon/gather.hpp"
#include "photon/sort_photons.hpp"

#include <span>

namespace argand {

/// How large the neighbourhoods are in which each pass estimates densities of photons.
struct Bandwidth {
    GatherRadii radii;                    ///< of the k nearest photons: r_max
    std::uint32_t neighbours = 0;         ///< k; 0: the estimator has none
    std::uint32_t caustic_neighbours = 0; ///< k of caustic photons alone; 0: there is none
    double smoothing = 0;                 ///< of footprints; 0: the estimator has none
    double caustic_smoothing = 0;
    bool caustics = false; ///< whether there are caustic photons
};

/// Writes the bandwidth of the last pass.
void report_bandwidth(const Bandwidth& bandwidth, RenderStatistics& statistics);

/// Saves or loads a bandwidth.
void persist_bandwidth(Archive& archive, Bandwidth& bandwidth);

/// Whether caustics have a smaller radius than other light.
inline bool has_sharp_caustics(const Bandwidth& bandwidth) {
    return bandwidth.radii.caustic < bandwidth.radii.indirect;
}

/// Whether an estimator with a radius for caustics queries them by themselves.
inline bool parts_sharp_caustics(const Bandwidth& bandwidth, bool may_part) {
    return may_part && bandwidth.caustics && has_sharp_caustics(bandwidth);
}

/// Photons of equal flux that would have as much noise as one photon in view; at most 1.
struct Evenness {
    double all = 1;
    double caustics = 1; ///< of caustic photons only
    double others = 1;
};

/// The first pass of a picture, from which its bandwidth is learnt.
struct FirstPass {
    Device& device;
    const DeviceScene& scene;
    PhotonWorkspace& workspace; ///< holds the pass's photons
    const StoredPhotons& stored;
    const SortedPhotons& photons;
    std::span<const glm::vec4> queries; ///< points at which the picture queries the photon map; the
                                        ///< fourth component does not count
    double passes = 1; ///< of as many photons each, over which the picture averages
    Evenness evenness;
};

/// The photons that one pass should find in a disc (or k), so that all passes together find the
/// best number. photons: that a pass stores.
double in_disc_of_pass(double photons, double passes, bool caustic = false);

/// The radii for a picture, from the density of the first pass's photons at its query points, and
/// whether there are caustics. A radius that the user has set is kept. neighbours,
/// caustic_neighbours: photons that a disc should hold, if that is given. Waits for the device.
Bandwidth learn_radii(const FirstPass& first, const RenderSettings& settings,
                      std::optional<std::uint32_t> neighbours = std::nullopt,
                      std::optional<std::uint32_t> caustic_neighbours = std::nullopt);

/// Adds the smoothing of footprints to a bandwidth that has radii, in the same way.
void learn_smoothing(Bandwidth& bandwidth, const FirstPass& first,
                     const FootprintSettings& settings);

/// The bandwidth for another number of passes than it was learnt for.
Bandwidth for_passes(const Bandwidth& learnt, double learnt_for, double passes,
                     const RenderSettings& settings);

/// The bandwidth of a pass of which all widths are `by` times those learnt, and which emits
/// `photons` times the photons: radii and smoothing, and k with the area and the photons, as long
/// as it is large enough to estimate a density. scene_radius: radii stay above the rounding of
/// positions in a scene of this size.
Bandwidth narrowed(const Bandwidth& learnt, double by, double photons, double scene_radius);

/// How many photons, in those of the first pass, a pass must emit so that its k nearest photons lie
/// within the radius that the law n^(-exponent) asks for, though k falls no further than narrowed()
/// lets it; at least 1. Of two k the larger one decides. learnt: the bandwidth of the first pass.
/// so_far: photons of all passes before.
double photon_growth(const Bandwidth& learnt, double so_far, double exponent);

/// The scale of the footprints of a pass that emits `photons` photons.
FootprintScale footprint_scale(const Bandwidth& bandwidth, const FootprintSettings& settings,
                               double photons, const SceneRecord& scene);

} // namespace argand
