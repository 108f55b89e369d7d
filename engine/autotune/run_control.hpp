#pragma once

#include "autotune/candidate.hpp"
#include "autotune/independent_halves.hpp"
#include "base/clock.hpp"
#include "methods/budget.hpp"

#include <optional>

namespace argand {

/// Default time limit in seconds for a target error without a time budget.
inline constexpr double default_time_limit = 3600;

/// The error of an image, measured while it is rendered.
struct MeasuredError {
    double passes = 0;   ///< after which it was measured
    double noise = 0;    ///< relMSE that is due to noise
    Estimate bias{0, 0}; ///< squared
    double error() const { return noise + bias.value; }
};

/// Controls the final render: measures its error, and decides after each pass whether to render
/// another.
class RunControl {
public:
    /// truth: estimated light without bias, if it is known. spent: seconds of the budget that are
    /// over. Keeps references to the target and to the truth.
    RunControl(const Target& target, const Candidate& candidate,
               const std::optional<ImagePair>& truth, double spent);

    /// Continues from the passes of a pilot, which become the first passes of the render. Call it
    /// before the first further pass.
    void continue_from(const Pilot& pilot);

    std::optional<PassPlan> operator()(const PictureSoFar& so_far);

    /// The last measurement. Nothing before both halves have a pass.
    const std::optional<MeasuredError>& measured() const { return measured_; }
    /// Whether the measured error is at most the target error.
    bool reached() const { return reached_; }

private:
    void add(const Image& mean_so_far, const Image& estimated_so_far);
    void measure();
    bool has_time(std::uint64_t done);
    double passes_in_time(std::uint64_t done) const;
    const MethodInfo& method() const;
    bool measures_bias() const;
    bool needs_estimated_light() const;
    double passes_to_target() const;
    bool takes_too_long(double times) const;

    const Target& target_;
    Candidate candidate_;
    const std::optional<ImagePair>& truth_;
    ErrorModel model_;
    double seconds_; ///< left for the render after the pilots
    Budget budget_;
    Clock::time_point start_;
    std::uint64_t inherited_passes_ = 0; ///< made by the pilot
    IndependentHalves halves_;           ///< of all light
    IndependentHalves estimated_;        ///< of estimated light, if it is needed
    std::optional<MeasuredError> measured_;
    bool reached_ = false;
};

} // namespace argand
