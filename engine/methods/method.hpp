#pragma once

#include "methods/budget.hpp"
#include "methods/eye_paths.hpp"
#include "methods/option.hpp"
#include "methods/render.hpp"
#include "methods/streams.hpp"
#include "methods/table.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace argand {

/// What a method can do and needs. The rest of Argand reads these instead of comparing names.
struct Abilities {
    bool unbiased = false; ///< the mean of its images is the truth, so that it serves as reference
    bool photon_map = false; ///< it estimates radiance from photons
    bool footprints = false; ///< its photons carry ray differentials
    bool resumable = true;   ///< it can add passes to an image until an error or a time is reached
};

/// How the error of an image of n passes falls:
///   relMSE(n) = (fixed + density n^noise_growth) / n + squared bias n^-bias_fall
/// for the coefficients of one pass (autotune/error_model.hpp). Both exponents are 0 for a method
/// without bandwidths.
struct ErrorLaw {
    double noise_growth = 0;
    double bias_fall = 0;
};

/// The law of all methods whose bandwidths shrink as n^(-1/6) (photon/radius.hpp), and areas as
/// n^(-1/3). The noise of density estimation grows with one over the area. Squared bias falls as
/// n^(-2/3) on smooth surfaces, where it goes with the area, and as n^(-1/6) along edges, in bands
/// as wide as the bandwidth: together about as n^(-1/3), as measured (docs/results/targets.md).
inline constexpr ErrorLaw photon_mapping_law{.noise_growth = 1.0 / 3, .bias_fall = 1.0 / 3};

/// The place of a method in a search for the fastest one to an error (autotune/exploration.hpp).
/// Unbiased methods are tried anyway: they tell the bias of the others.
enum class TrialOrder : std::uint8_t { never, first, later };

/// What the passes of one image share, whichever method makes them.
struct RenderContext {
    Device& device;
    const Scene& scene;
    const RenderSettings& settings;
    DeviceScene on_device;
    EyeWorkspace eye; ///< holds the film
};

/// One pass.
struct Pass {
    double expected = 1; ///< passes of the whole image, as far as is known
    PassNumbers numbers; ///< the random numbers that it takes
};

/// Told the share of a pass that is done; returns false to stop after the current batch.
using OnPart = std::function<bool(double)>;

/// A method at work on one image. It owns what outlives a pass.
class Method {
public:
    virtual ~Method() = default;

    /// Does the work that precedes the first pass. The time of the first pass begins where this
    /// calls budget.start_pass(); work that only the first pass has goes into budget.once().
    virtual void begin(Budget& budget) { budget.start_pass(); }

    /// Passes over which the samples and photons of the settings are spread. Known after begin().
    virtual std::uint64_t passes() const { return 1; }

    /// Adds one pass to the film. Returns false if `on_part` did; the film then holds the samples
    /// that were finished.
    virtual bool pass(const Pass& pass, const OnPart& on_part) = 0;

    /// Whether the pass of this index within its stream has random numbers of its own.
    virtual bool has_numbers(std::uint64_t index) const = 0;

    /// Writes what the method did so far.
    virtual void report(RenderStatistics& statistics) const = 0;
};

/// A row of the method table.
struct MethodInfo {
    std::string name;
    std::string summary; ///< half a line: "path tracing without bias"
    std::string paper;   ///< "Jensen 1996"
    Abilities abilities;
    ErrorLaw law;
    TrialOrder trial = TrialOrder::never;
    std::vector<Option> options; ///< in the order in which settings are listed
    std::unique_ptr<Method> (*make)(RenderContext& context) = nullptr;

    /// Null if the method does not have the option.
    const Option* option(std::string_view option_name) const;
};

} // namespace argand
