#pragma once

#include "autotune/error_model.hpp"
#include "base/clock.hpp"
#include "session/render.hpp"

#include <functional>
#include <optional>
#include <span>
#include <utility>

namespace argand {

/// The second half of a pilot uses the bandwidth of a render of this many passes.
inline constexpr double reduced_for_passes = 8;

struct PilotImages {
    ImagePair whole;     ///< all light
    ImagePair estimated; ///< the light that is estimated from photons
    ImagePair caustic;   ///< of that, caustics
};

/// The images of several renders with the same settings of a pass, pooled by their samples.
struct PooledImages {
    std::optional<PilotImages> images;
    double samples = 0; ///< eye paths per pixel, both halves together
    double seconds = 0; ///< spent on the renders

    void add(const PilotImages& more, double samples_of_more, double seconds_of_more);
};

/// Passes of a complete pilot.
inline constexpr std::uint64_t pilot_passes = 4;
/// The first passes of a pilot, which use the initial bandwidth: that of a render of one pass.
inline constexpr std::uint64_t initial_pilot_passes = pilot_passes / 2;

/// A few passes of some settings, which measure their cost and their error. The first half of the
/// passes uses the initial bandwidth, the second half the reduced bandwidth for
/// `reduced_for_passes`. All passes are alike if the method has no bandwidth.
struct Pilot {
    const MethodInfo* method; ///< of the settings
    RenderSettings settings;  ///< of one pass
    /// Fewer than `pilot_passes` if it took too long, or was interrupted. With 3, `reduced` has the
    /// third pass and repeats the second; with 2, it repeats `initial`; with 1, all images are the
    /// same one.
    std::uint64_t passes = 0;
    PilotImages initial, reduced;
    /// Measured over the reduced passes, or else the second pass, or else the first, which also
    /// loads kernels.
    double seconds_per_pass = 0;
    double seconds = 0; ///< of the whole pilot
};

/// Asked after each initial pass whether the pilot may end here.
using IsEnough = std::function<bool(const Pilot& so_far)>;

/// Controls the passes of a pilot, and collects their images.
class PilotControl {
public:
    PilotControl(const MethodInfo& method, const RenderSettings& settings, IsEnough is_enough)
        : is_enough_(std::move(is_enough)), pilot_{.method = &method, .settings = settings},
          start_(Clock::now()) {}

    /// The next pass. Nothing once the pilot is complete, or enough.
    std::optional<PassPlan> operator()(const PictureSoFar& so_far);

    /// The pilot with the passes made so far.
    Pilot take() && { return std::move(pilot_); }

private:
    void add(const PictureSoFar& so_far);

    IsEnough is_enough_;
    Pilot pilot_;
    Clock::time_point start_;
    double seconds_before_ = 0; ///< at the start of the passes that are timed
    std::uint64_t passes_before_ = 0;
    Image before_, estimated_before_, caustic_before_;
};

/// The best guess of the true image, for the denominator of relMSE: guess_from() the least noisy
/// pilot, smoothed.
Image best_guess(std::span<const Pilot> pilots);

/// The light that a method estimates from photons, the only light that has bias: all but direct
/// light.
Image estimated_light(std::span<const Layer> layers);

/// The layer of caustics; black if there is none.
Image caustic_light(std::span<const Layer> layers);

/// Fits the pilot's error model. The squared bias combines three sources, each weighted by its
/// uncertainty: the bias that is usual, the difference between the two bandwidths, and the
/// difference from `truth`, estimated light without bias (null if it is unknown). The variance is
/// infinite if the pilot has one pass only.
ErrorModel model_of(const Pilot& pilot, const ImagePair* truth, const Image& guess);

/// The squared bias that is usual after `passes` passes.
Prior usual_bias_after(const ErrorModel& model, double passes);

/// Squared bias of estimated light after `passes` passes, from the bias that is usual and from the
/// difference from `truth`, the same light without bias.
Estimate bias_of(const ImagePair& estimated, const ErrorModel& model, double passes,
                 const ImagePair& truth, const Image& guess);

} // namespace argand
