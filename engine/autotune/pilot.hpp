#pragma once

#include "autotune/error_model.hpp"
#include "base/clock.hpp"
#include "methods/render.hpp"

#include <functional>
#include <optional>
#include <span>
#include <utility>

namespace argand {

/// Passes for whose widths of estimation a pilot's later pictures are.
inline constexpr double narrow_passes = 8;

struct PilotPictures {
    Pair whole, estimated; ///< all light; that which is estimated from photons
};

/// Passes of a whole pilot.
inline constexpr std::uint64_t pilot_passes = 4;
inline constexpr std::uint64_t wide_passes = pilot_passes / 2;

/// A few passes of some settings, to learn what they cost and how far from the truth they are. Half
/// of them are at the widths of estimation for one pass, half at those for `narrow_passes`; all are
/// alike if the method has no such widths.
struct Pilot {
    const MethodInfo* method; ///< of the settings
    RenderSettings settings;  ///< of one pass
    std::uint64_t passes =
        0; ///< fewer than all: it took too long; 2: no narrow ones; 1: one picture is all there is
    PilotPictures wide, narrow;
    double seconds_per_pass =
        0; ///< of the narrow ones, or the second one, or the first, which loads kernels
    double seconds = 0; ///< that it took
};

/// Asked after each wide pass whether the pilot so far is enough.
using IsEnough = std::function<bool(const Pilot& so_far)>;

/// Decides on a pilot's passes, and takes their pictures.
class PilotCourse {
public:
    PilotCourse(const MethodInfo& method, const RenderSettings& settings, IsEnough is_enough)
        : is_enough_(std::move(is_enough)), pilot_{.method = &method, .settings = settings},
          start_(Clock::now()) {}

    /// Nothing once the pilot is whole, or enough.
    std::optional<PassPlan> operator()(const PictureSoFar& so_far);

    /// What the passes so far have told.
    Pilot take() && { return std::move(pilot_); }

private:
    void add(const PictureSoFar& so_far);

    IsEnough is_enough_;
    Pilot pilot_;
    Clock::time_point start_;
    double seconds_before_ = 0; ///< before the passes whose time counts
    std::uint64_t passes_before_ = 0;
    Image before_, estimated_before_;
};

/// What relMSE divides by, as far as it is known: guess_from() the least noisy pilot, smoothed.
Image best_guess(std::span<const Pilot> pilots);

/// The light that photon mapping estimates from photons, and the only one that has bias: all but
/// direct light.
Image estimated_light(std::span<const Layer> layers);

/// The pilot's model. Squared bias from what is usual, from the difference of the two widths, and
/// from the estimated light without bias, if it is known (else null), each as far as its noise lets
/// it tell. Infinite variance from one pass.
ErrorModel model_of(const Pilot& pilot, const Pair* truth, const Image& guess);

/// Squared bias of estimated light after so many passes: from what is usual, and from the same
/// light without bias.
Estimate bias_of(const Pair& estimated, const ErrorModel& model, double passes, const Pair& truth,
                 const Image& guess);

} // namespace argand
