#pragma once

#include "autotune/candidate.hpp"
#include "autotune/independent_halves.hpp"
#include "autotune/measured_error.hpp"
#include "autotune/witness.hpp"
#include "base/clock.hpp"
#include "methods/budget.hpp"

#include <optional>

namespace argand {

/// Default time limit in seconds for a target error without a time budget.
inline constexpr double default_time_limit = 3600;

/// How a final render ended.
enum class RunOutcome : std::uint8_t {
    unfinished,  ///< the target error was not reached
    reached,     ///< by noise and bias, and a witness confirms it if the method has bias
    unconfirmed, ///< by noise and bias, but no witness could confirm it in time
    slow,        ///< more bias than expected, or overdue: the witness's method gets there sooner
    too_long     ///< the target error would take longer than default_time_limit
};

/// Who judges a picture. Null: nobody.
struct Witnesses {
    Witness* picture = nullptr;  ///< all of it
    Witness* caustics = nullptr; ///< of caustics, the narrow passes that judge them instead
};

/// Controls the final render: measures its error, and decides after each pass whether to render
/// another. A method with bias does not reach the target error on the word of its error model: a
/// witness must confirm it.
class RunControl {
public:
    /// witnesses: none if the method has no bias. may_switch: the render may end where the method
    /// of the picture's witness is faster. spent: seconds of the budget that are over. Keeps a
    /// reference to the target, and the pointers.
    RunControl(const Target& target, const Candidate& candidate, const Witnesses& witnesses,
               bool may_switch, double spent);

    /// Continues from the passes of a pilot, which become the first passes of the render. Call it
    /// before the first further pass.
    void continue_from(const Pilot& pilot);

    std::optional<PassPlan> operator()(const PictureSoFar& so_far);

    /// The last measurement. Nothing before both halves have a pass.
    const std::optional<MeasuredError>& measured() const { return measured_; }
    RunOutcome outcome() const { return outcome_; }
    /// Whether the user has interrupted a witness.
    bool is_interrupted() const { return is_interrupted_; }
    /// The candidate that reaches the target error with the witness's method. Requires a
    /// measurement with pictures of the witness.
    Candidate of_witness() const;

private:
    /// More passes of a witness.
    struct Request {
        Witness* witness;
        double passes;
    };

    void add(const Image& mean_so_far, const Image& estimated_so_far, const Image& caustic_so_far);
    Image guess_of(const ImagePair& images) const;
    void measure();
    bool has_time(std::uint64_t done);
    double passes_in_time(std::uint64_t done) const;
    const MethodInfo& method() const;
    Estimate expected_bias(const Image& guess) const;
    Judgement judgement() const;
    bool needs_estimated_light() const;
    void question();
    void hear_witnesses(const Image& guess);
    bool all_witnesses_have_spoken() const;
    bool may_go_on_in_doubt() const;
    Request next_request() const;
    bool has_time_for(const Witness& witness) const;
    bool ask(const Request& request);
    double seconds_of_witnesses() const;
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
    Witness* caustic_witness_;
    bool may_switch_;
    double spent_;                   ///< seconds before the render
    double variance_of_witness_ = 0; ///< of one of its passes
    bool is_doubtful_ = false;       ///< the target error seems reached, but for the witness
    double doubted_since_ = 0;       ///< passes at which it first seemed reached
    double expected_ = 1;            ///< passes, when the last one was planned
    ErrorModel model_;
    double seconds_; ///< left for the render after the pilots
    Budget budget_;
    Clock::time_point start_;
    std::uint64_t inherited_passes_ = 0; ///< made by the pilot
    IndependentHalves halves_;           ///< of all light
    IndependentHalves estimated_;        ///< of estimated light, if it is needed
    IndependentHalves caustic_;          ///< of caustics, if they have a witness
    bool judges_caustics_ = false;       ///< there are caustics that need their witness
    std::optional<MeasuredError> measured_;
    RunOutcome outcome_ = RunOutcome::unfinished;
    bool is_interrupted_ = false;
};

} // namespace argand
