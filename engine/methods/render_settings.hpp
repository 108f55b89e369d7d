#pragma once

#include "methods/table.hpp"
#include "photon/disc_settings.hpp"
#include "photon/frontier_settings.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace argand {

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

/// Widths of estimation that fall from pass to pass (docs/methods/progressive.md), for methods with
/// a photon map.
struct ProgressiveSettings {
    bool on = false;
    std::optional<double> first_radius; ///< r1, of the first pass, in scene units; none: from the
                                        ///< scene
    double exponent = 0.25;             ///< a in r(n) = r1 (n / n1)^(-a), between 0 and 1/2
    std::uint32_t passes = 1;           ///< how often the image's photons and samples are repeated
};

/// Where the numbers come from that decide the first vertices of paths: Owen-scrambled Sobol'
/// points, or a hash.
enum class Sampling { sobol, random };

/// How a photon map's queries find photons: each by itself through a tree over the photons, or all
/// together without one (Keller et al. 2010).
enum class QuerySearch : std::uint8_t { automatic, tree, simultaneous };

/// How the samples of a pixel are placed: evenly in it, or by a wider filter around its middle
/// (shared/pixel_filter.h).
enum class PixelFilter : std::uint8_t { box, blackman_harris };

/// Pixels x0 <= x < x1, y0 <= y < y1 of an image, from its top left corner.
struct CropRectangle {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};

/// A request for an image.
struct RenderSettings {
    std::string method = default_method(); ///< a name in the method table
    int width = 512;
    int height = 512;
    std::optional<CropRectangle> crop; ///< renders only these pixels of it; not empty
    PixelFilter filter = PixelFilter::box;
    /// Eye paths per pixel. A photon map whose photons are spread over several passes uses at least
    /// one for each pass; RenderStatistics tells how many.
    std::uint32_t samples = 8;
    std::uint64_t photons = 200'000; ///< emitted, all passes together
    /// Maximum for one pass, at least 1. It bounds the memory that any number of photons takes.
    std::uint64_t photons_per_pass = 1 << 18;
    /// Maximum of one pass, at least 1, unless the passes' photons ask for more: a photon map that
    /// serves more samples has several passes (methods/sample_parts.hpp). The image is the same.
    std::uint32_t samples_per_pass = 0xffffffff;
    /// Passes over which the image is spread at least, but no more than samples (`path`) or
    /// photons, if there are any: a shutter (session/shutter.hpp) gives each pass a moment of its
    /// own.
    std::uint32_t least_passes = 1;
    /// Seconds: samples and photons are repeated until then.
    std::optional<double> budget;
    /// Maximum number of scatterings between a light and the first estimated vertex.
    std::uint32_t bounces = unlimited_bounces;
    std::optional<double> radius; ///< of density estimation, in scene units; `knn`: r_max
    /// k of `knn` in each pass, at least 1; none: from the photons stored.
    std::optional<std::uint32_t> neighbours;
    std::optional<std::uint32_t> caustic_neighbours; ///< the same for caustic photons
    std::uint32_t seed = 0;
    std::size_t camera = 0; ///< index into Scene::cameras
    double aperture = 0;    ///< diameter of the camera's lens, in scene units; 0: a pinhole
    /// Distance along the camera's axis at which the image is sharp, in scene units; none: that of
    /// what is in the image's middle.
    std::optional<double> focus;
    float follow_roughness = 0.25f; ///< glossy lobes up to this roughness are followed from the eye
    /// The eye, also in mirrors and through glass, does not see one-sided surfaces from behind.
    bool cull_back_faces = false;
    /// Edge of the cells that share one density estimate, in radii of estimation; 0: no sharing.
    double query_cell = 0.25;
    /// Least share of an estimate's disc that lies on surfaces; with less the estimate is not
    /// taken, and the eye path goes on. 0: all estimates are taken; none: from `samples`.
    std::optional<double> least_coverage;
    /// Distance within which eye paths follow the light of other surfaces instead of taking it from
    /// the map, in scene units; 0: never; none: from the scene.
    std::optional<double> near_field;
    std::uint32_t leaf_size = 0; ///< photons in a leaf of the photon map; 0: 16
    bool wide_codes = false;     ///< photons are sorted by 63-bit Morton codes, not 30-bit ones
    QuerySearch query = QuerySearch::automatic;
    FrontierSettings frontier; ///< of queries that are answered together
    Sampling photon_sampling = Sampling::sobol;
    /// All paths take the points of a lattice instead, which no seed decides.
    bool deterministic = false;
    /// Results have a layer "variance" (methods/film_variance.hpp). It needs two passes at least.
    bool variance = false;
    bool final_gather = false; ///< the photon map is queried one bounce later, except for caustics
    bool everything = false;   ///< also code, buffers and passes that the scene does not require
    FootprintSettings footprints;
    DiscSettings disc; ///< of a fixed radius
    ProgressiveSettings progressive;
    /// Values of options that have no member above, by name (own_option() of methods/option.hpp).
    std::map<std::string, std::string> own;
};

/// The least coverage of estimates that are taken. Estimates on thin things are blurred, and paths
/// that go on instead are noisy: where samples are many, more paths go on, because noise falls with
/// the samples and blur does not.
inline double least_coverage_of(const RenderSettings& settings) {
    constexpr std::uint32_t many_samples = 64;
    return settings.least_coverage.value_or(settings.samples < many_samples ? 0.1 : 0.2);
}

} // namespace argand
