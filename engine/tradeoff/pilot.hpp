#pragma once

#include "methods/render.hpp"
#include "tradeoff/error_model.hpp"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace argand {

/// Renders the settings' samples and photons again and again, as argand::render with `on_pass`.
using RenderPasses = std::function<RenderResult(const RenderSettings& settings, const OnPass& on_pass)>;

/// Passes for whose widths of estimation a pilot's later pictures are.
inline constexpr double narrow_passes = 8;

/// A few passes of some settings, to learn what they cost and how far from the truth they are. Half of them are at the
/// widths of estimation for one pass, half at those for `narrow_passes`; all are alike if the method has no such widths.
struct Pilot {
    RenderSettings settings;            ///< of one pass
    std::array<Image, 2> wide, narrow;  ///< of independent noise
    double seconds_per_pass = 0;        ///< of the narrow ones
    double seconds = 0;                 ///< that it took
};

/// Nothing if it was interrupted.
std::optional<Pilot> run_pilot(const RenderPasses& render, const RenderSettings& settings);

/// What relMSE divides by, as far as it is known: the least noisy pilot's picture, smoothed.
Image best_guess(const std::vector<Pilot>& pilots);

/// Two pictures of independent noise without bias.
using Truth = std::array<Image, 2>;

/// The pilot's model. Squared bias from what is usual, from the difference of the two widths, and from the truth, if there
/// is one (else null), each as far as its noise lets it tell.
ErrorModel model_of(const Pilot& pilot, const Truth* truth, const Image& guess);

} // namespace argand
