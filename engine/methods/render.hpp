#pragma once

#include "device/device.hpp"
#include "image/image.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "shared/footprint_records.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace argand {

/// Of the method `footprints` (docs/methods/footprints.md).
struct FootprintSettings {
    std::optional<double> smoothing; ///< s of Fabianowski and Dingliana 2009; none: from the scene
    double caustic_smoothing =
        4; ///< the same of photons that only mirrors and glass have scattered
    std::optional<double>
        largest;                 ///< semi-axis at most, in the scene's radii; none: from the scene
    double flatness = 0.3;       ///< half-axis along the normal over the mean of the others
    bool uniform_kernel = false; ///< instead of Epanechnikov's
    bool fixed_smoothing =
        false; ///< footprints shrink as n^(-1/2), as in the paper, not as n^(-1/6)
    bool paper_axes =
        false; ///< the differentials are compressed as they are, not the ellipse's axes
    bool paper_reemission = false; ///< diffuse reflection spaces photons as the paper does
    std::uint32_t leaf_size = 0;   ///< photons in a leaf of the map at most; 0: automatic
};

/// Where numbers come from that decide the first vertices of paths: Owen-scrambled Sobol' points,
/// or a hash.
enum class Sampling { sobol, random };

/// What a user asks for.
struct RenderSettings {
    std::string method = "footprints";
    int width = 512;
    int height = 512;
    std::uint32_t samples =
        8; ///< eye paths per pixel; photon maps: at least, for each of the passes
           ///< over which many photons are spread has as many, RenderStatistics
    std::uint64_t photons = 200'000; ///< photons emitted in all
    std::uint64_t photons_per_pass =
        1 << 18; ///< at most, at least 1: so much memory is enough for any number
    std::optional<double>
        budget; ///< seconds: so many samples and photons again and again until then
    std::uint32_t bounces =
        0xffff;                   ///< the most scatterings between light and first estimated vertex
    std::optional<double> radius; ///< of density estimation, in the scene's units; of `knn`: r_max
    std::optional<std::uint32_t>
        neighbours; ///< k of `knn` in each pass, at least 1; none: from the photons stored
    std::uint32_t seed = 0;
    std::size_t camera = 0;         ///< index into Scene::cameras
    float follow_roughness = 0.25f; ///< glossy lobes at most this rough are followed from the eye
    double query_cell = 0.25; ///< edge of the cells in which one density estimate is shared, in
                              ///< radii of estimation; 0: none are shared
    bool wide_codes = false;  ///< Morton codes of 63 bits for photons, not of 30
    Sampling photon_sampling = Sampling::sobol;
    bool final_gather = false; ///< the photon map is asked one bounce later, but for caustics
    bool everything = false;   ///< also code, buffers and passes that the scene does not require
    FootprintSettings footprints;
};

/// Flux by channel in units of FluxSums::unit: emitted = absorbed + escaped + cut, exactly.
struct FluxSums {
    std::array<std::int64_t, 3> emitted{}, absorbed{}, escaped{}, cut{};
    double unit = 0;
};

/// What happened while rendering.
struct RenderStatistics {
    std::uint64_t samples = 0; ///< eye paths per pixel that were traced
    std::uint64_t passes = 0;
    std::uint64_t photons_emitted = 0;
    std::uint64_t photons_stored = 0;
    double radius = 0;                             ///< that was used; 0: none
    double caustic_radius = 0;                     ///< the same for caustic photons
    std::uint32_t neighbours = 0;                  ///< k of `knn`; 0: none
    double smoothing = 0;                          ///< of footprints; 0: none
    double mean_footprints = 0;                    ///< on a point, if they were spread evenly
    std::uint32_t leaf_size = 0;                   ///< photons in a leaf of the map at most
    std::optional<FootprintScale> footprint_scale; ///< of every pass; none: no footprints
    std::uint64_t non_finite = 0; ///< samples left out because they were not finite
    FluxSums flux;
    bool interrupted = false; ///< every pixel holds the samples that were finished, maybe none
};

struct RenderResult {
    std::vector<Layer> layers; ///< "" (the picture), "direct", "indirect", "caustic"
    RenderStatistics statistics;
};

/// Told the share of the work that is done; returns false to stop after the current batch.
using OnProgress = std::function<bool(double)>;

/// A picture of which more passes may follow.
struct PictureSoFar {
    std::uint64_t passes = 0;                   ///< whose mean it is; 0: it is still black
    std::function<std::vector<Layer>()> layers; ///< as in RenderResult; waits for the device
};

/// The next pass.
struct PassPlan {
    double expected = 1; ///< passes in all, as far as is known: from it follow widths of estimation
    std::uint32_t stream =
        0; ///< passes of different streams have independent noise; the first pass: 0
};

/// Asked before the first pass and after each for the next one; none: no more.
using OnPass = std::function<std::optional<PassPlan>(const PictureSoFar&)>;

/// Names of the methods, the default first.
std::vector<std::string> method_names();

/// What the scene and the settings require.
Plan plan_render(const Scene& scene, const RenderSettings& settings);

/// Renders the scene. With `on_pass` samples and photons are those of one pass, and it decides, not
/// a budget, how often there is another. Throws UsageError on an unknown method, Error if the
/// device cannot do it.
RenderResult render(Device& device, const Scene& scene, const RenderSettings& settings,
                    const OnProgress& progress, const OnPass& on_pass = nullptr);

} // namespace argand
