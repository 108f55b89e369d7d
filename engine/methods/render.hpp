#pragma once

#include "device/device.hpp"
#include "image/image.hpp"
#include "methods/table.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "shared/footprint_records.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace argand {

class World;

/// The largest value of RenderSettings::bounces: no path is truncated, but by Russian roulette.
inline constexpr std::uint32_t unlimited_bounces = 0xffff;

/// Options of the method `footprints` (docs/methods/footprints.md).
struct FootprintSettings {
    std::optional<double> smoothing; ///< s of Fabianowski and Dingliana 2009; none: from the scene
    double caustic_smoothing = 4;    ///< s of photons that only mirrors and glass have scattered
    std::optional<double> largest;   ///< maximum semi-axis, in scene radii; none: from the scene
    double flatness = 0.3;           ///< half-axis along the normal over the mean of the others
    bool uniform_kernel = false;     ///< instead of Epanechnikov's
    /// Footprints shrink as n^(-1/2) with the number n of photons, as in the paper, not n^(-1/6).
    bool fixed_smoothing = false;
    bool paper_axes = false; ///< bounds differentials as they are, not the axes of the ellipse
    bool paper_reemission = false; ///< diffuse reflection spaces photons as the paper does
};

/// Where the numbers come from that decide the first vertices of paths: Owen-scrambled Sobol'
/// points, or a hash.
enum class Sampling { sobol, random };

/// A request for an image.
struct RenderSettings {
    std::string method = default_method(); ///< a name in the method table
    int width = 512;
    int height = 512;
    /// Eye paths per pixel. A photon map whose photons are spread over several passes uses at least
    /// one for each pass; RenderStatistics tells how many.
    std::uint32_t samples = 8;
    std::uint64_t photons = 200'000; ///< emitted, all passes together
    /// Maximum for one pass, at least 1. It bounds the memory that any number of photons takes.
    std::uint64_t photons_per_pass = 1 << 18;
    /// Seconds: samples and photons are repeated until then.
    std::optional<double> budget;
    /// Maximum number of scatterings between a light and the first estimated vertex.
    std::uint32_t bounces = unlimited_bounces;
    std::optional<double> radius; ///< of density estimation, in scene units; `knn`: r_max
    /// k of `knn` in each pass, at least 1; none: from the photons stored.
    std::optional<std::uint32_t> neighbours;
    std::uint32_t seed = 0;
    std::size_t camera = 0;         ///< index into Scene::cameras
    float follow_roughness = 0.25f; ///< glossy lobes up to this roughness are followed from the eye
    /// Edge of the cells that share one density estimate, in radii of estimation; 0: no sharing.
    double query_cell = 0.25;
    std::uint32_t leaf_size = 0; ///< photons in a leaf of the photon map; 0: 16
    bool wide_codes = false;     ///< photons are sorted by 63-bit Morton codes, not 30-bit ones
    Sampling photon_sampling = Sampling::sobol;
    bool final_gather = false; ///< the photon map is queried one bounce later, except for caustics
    bool everything = false;   ///< also code, buffers and passes that the scene does not require
    FootprintSettings footprints;
    /// Values of options that have no member above, by name (own_option() of methods/option.hpp).
    std::map<std::string, std::string> own;
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
    // Of the last pass; 0 where the method has no such thing.
    double radius = 0;
    double caustic_radius = 0; ///< radius for caustic photons
    std::uint32_t neighbours = 0;
    double smoothing = 0;
    double mean_footprints = 0;  ///< footprints on a point, if they were spread evenly
    std::uint32_t leaf_size = 0; ///< maximum number of photons in a leaf of the map
    std::optional<FootprintScale> footprint_scale; ///< none: photons are points
    std::uint64_t non_finite = 0; ///< samples left out because they were not finite
    FluxSums flux;
    bool interrupted = false; ///< pixels hold the samples that were finished, maybe none
    /// What a method counts beside all this, by a name that is a key of JSON.
    std::map<std::string, double> own;
};

struct RenderResult {
    std::vector<Layer> layers; ///< "" (the whole image), "direct", "indirect", "caustic"
    RenderStatistics statistics;
};

/// Told the share of the work that is done; returns false to stop after the current batch.
using OnProgress = std::function<bool(double)>;

/// An image to which passes may be added.
struct PictureSoFar {
    std::uint64_t passes = 0;                   ///< whose mean it is; 0: it is still black
    std::function<std::vector<Layer>()> layers; ///< as in RenderResult; waits for the device
};

/// A request for one more pass.
struct PassPlan {
    /// Passes of the whole image, as far as is known: bandwidths follow from it.
    double expected = 1;
    /// Passes of different streams have independent noise. The first pass must be of stream 0.
    std::uint32_t stream = 0;
};

/// Called before the first pass and after each pass for the next one; none: no more.
using OnPass = std::function<std::optional<PassPlan>(const PictureSoFar&)>;

/// What the scene and the settings require. Throws UsageError on an unknown method.
Plan plan_render(const Scene& scene, const RenderSettings& settings,
                 MethodTable methods = builtin_methods());

/// The method for a scene if the user names none: the table's first, `footprints`, where there may
/// be caustics, else the one that autotuning tries first, `photons` (docs/photon-map.md).
const MethodInfo& method_for(const Scene& scene, const RenderSettings& settings,
                             MethodTable methods = builtin_methods());

/// Renders the scene that `world` holds. With `on_pass` the settings' samples and photons are those
/// of one pass, and on_pass decides how many passes there are, not the budget. Throws UsageError on
/// an unknown method, Error if the device cannot do it.
RenderResult render(World& world, const Scene& scene, const RenderSettings& settings,
                    const OnProgress& progress, const OnPass& on_pass = nullptr,
                    MethodTable methods = builtin_methods());

/// As above, in a world of its own.
RenderResult render(Device& device, const Scene& scene, const RenderSettings& settings,
                    const OnProgress& progress, const OnPass& on_pass = nullptr,
                    MethodTable methods = builtin_methods());

} // namespace argand
