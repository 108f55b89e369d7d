#pragma once

#include "methods/option.hpp"
#include "methods/table.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace argand {

class Method;
struct RenderContext;

/// What a method can do and needs. The rest of Argand reads these instead of comparing names.
struct Abilities {
    bool unbiased = false; ///< the mean of its images is the truth, so that it serves as reference
    bool photon_map = false;    ///< it estimates radiance from photons
    bool light_paths = false;   ///< it connects the hits of photons with the eye
    bool footprints = false;    ///< its photons carry ray differentials
    bool progressive = false;   ///< its widths fall from pass to pass, without an option for that
    bool keeps_photons = false; ///< images depend on those before them in the same session
    /// Photons find their hits in cube maps, which do not show everything: some are lost, and some
    /// hit what lies behind.
    bool approximate_hits = false;
};

/// How the error of an image of n passes falls:
///   relMSE(n) = (fixed + density n^noise_growth) / n + squared bias n^-bias_fall
/// for the coefficients of one pass (autotune/error_model.hpp). Both exponents are 0 for a method
/// without bandwidths.
struct ErrorLaw {
    double noise_growth = 0;
    double bias_fall = 0;
    /// Pass i has the bandwidth of a render of i passes, not all passes that of n: the powers of n
    /// are means of powers of i.
    bool by_pass = false;
};

/// The law of all methods whose bandwidths shrink as n^(-1/6) (photon/radius.hpp), and areas as
/// n^(-1/3). The noise of density estimation grows with one over the area. Squared bias falls as
/// n^(-2/3) on smooth surfaces, where it goes with the area, and as n^(-1/6) along edges, in bands
/// as wide as the bandwidth: together about as n^(-1/3), as measured (docs/results/targets.md).
inline constexpr ErrorLaw photon_mapping_law{.noise_growth = 1.0 / 3, .bias_fall = 1.0 / 3};

/// The law of widths that fall from pass to pass, pass i having width i^(-exponent): that above
/// with another exponent.
constexpr ErrorLaw progressive_law(double exponent) {
    return {.noise_growth = 2 * exponent, .bias_fall = 2 * exponent, .by_pass = true};
}

/// The place of a method in a search for the fastest one to an error (autotune/exploration.hpp).
/// The first unbiased method is tried anyway: it tells the bias of the others. Exactly one method
/// is `first`.
enum class TrialOrder : std::uint8_t { never, first, later };

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
    /// Whether photons carry ray differentials with these settings, where that depends on an
    /// option; null: abilities.footprints tells.
    bool (*wants_footprints)(const RenderSettings& settings) = nullptr;

    /// Null if the method does not have the option.
    const Option* option(std::string_view option_name) const;
};

/// Whether widths of estimation fall from pass to pass.
bool is_progressive(const MethodInfo& method, const RenderSettings& settings);

/// The law of the method with these settings.
ErrorLaw law_of(const MethodInfo& method, const RenderSettings& settings);

} // namespace argand
