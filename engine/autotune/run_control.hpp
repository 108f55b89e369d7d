#pragma once

#include "autotune/candidate.hpp"
#include "autotune/independent_halves.hpp"
#include "autotune/witness.hpp"
#include "base/clock.hpp"
#include "methods/budget.hpp"

#include <optional>

namespace argand {

/// Default time limit in seconds for a target error without a time budget.
inline constexpr double default_time_limit = 3600;

/// The error of an image, measured while it is rendered.
struct MeasuredError {
    double passes = 0;                  ///< after which it was measured
    double noise = 0;                   ///< relMSE that is due to noise
    Estimate bias{0, 0};                ///< squared
    std::optional<Testimony> testimony; ///< of the witness, if there is one so far
    double error() const { return noise + bias.value; }
};

/// How a final render ended.
enum class RunOutcome : std::uint8_t {
    unfinished,  ///< the target error was not reached
    reached,     ///< by noise and bias, and a witness confirms it if the method has bias
    unconfirmed, ///< by noise and bias, but no witness could confirm it in time
    slow         ///< more bias than expected, or overdue: the witness's method gets there sooner
};

/// Controls the final render: measures its error, and decides after each pass whether to render
/// another. A method with bias does not reach the target error on the word of its error model: a
/// witness must confirm it.
class RunControl {
public:
    /// witness: null if the method has no bias. may_switch: the render may end where the witness's
    /// method is faster. spent: seconds of the budget that are over. Keeps a reference to the
    /// target, and the pointer.
    RunControl(const Target& target, const Candidate& candidate, Witness* witness, bool may_switch,
               double spent);

    /// Continues from the passes of a pilot, which become the first passes of the render. Call it
    /// before the first further pass.
    void continue_from(const Pilot& pilot);

    std::optional<PassPlan> operator()(const PictureSoFar& so_far);

    /// The last measurement. Nothing before both halves have a pass.
    const std::optional<MeasuredError>& measured() const { return measured_; }
    RunOutcome outcome() const { return outcome_; }
    /// The candidate that reaches the target error with the witness's method. Requires a
    /// measurement with pictures of the witness.
    Candidate of_witness() const;

private:
    void add(const Image& mean_so_far, const Image& estimated_so_far);
    void measure();
    bool has_time(std::uint64_t done);
    double passes_in_time(std::uint64_t done) const;
    const MethodInfo& method() const;
    Estimate expected_bias(const Image& guess) const;
    Judgement judgement() const;
    bool needs_estimated_light() const;
    void question();
    bool ask_witness(double passes);
    double seconds_of_witness_left() const;
    double own_seconds() const;
    bool is_overdue() const;
    void complete_witness();
    bool witness_is_faster(std::uint64_t done) const;
    double passes_to_target() const;
    bool takes_too_long(double times) const;

    const Target& target_;
    Candidate candidate_;
    Witness* witness_;
    bool may_switch_;
    double spent_;                   ///< seconds before the render
    double variance_of_witness_ = 0; ///< of one of its passes
    bool is_doubtful_ = false;       ///< the target error seems reached, but for the witness
    double expected_ = 1;            ///< passes, when the last one was planned
    ErrorModel model_;
    double seconds_; ///< left for the render after the pilots
    Budget budget_;
    Clock::time_point start_;
    std::uint64_t inherited_passes_ = 0; ///< made by the pilot
    IndependentHalves halves_;           ///< of all light
    IndependentHalves estimated_;        ///< of estimated light, if it is needed
    std::optional<MeasuredError> measured_;
    RunOutcome outcome_ = RunOutcome::unfinished;
};

} // namespace argand
