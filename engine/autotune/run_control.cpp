#include "autotune/run_control.hpp"

#include "image/mean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {

namespace {

// From this number of passes on, the denominator of relMSE follows from single pixels. Earlier it
// follows from smoothed images, because a penumbra may be black in one of the halves.
constexpr double passes_for_pixels = 16;
constexpr double unlimited = std::numeric_limits<double>::infinity();
// A witness confirms that the error is at most so many times the target error.
constexpr double tolerance = 1.5;
// Without a time budget a witness may take this many times as long as all else, and at least these
// seconds.
constexpr double most_of_witness = 2, seconds_of_witness = 2;
// A render is overdue after so many times the promised passes, and at least these seconds.
constexpr double most_of_promise = 2, least_overdue = 2;

} // namespace

RunControl::RunControl(const Target& target, const Candidate& candidate, Witness* witness,
                       bool may_switch, double spent)
    : target_(target), candidate_(candidate), witness_(witness), may_switch_(may_switch),
      spent_(spent), model_(candidate.model),
      seconds_(target.seconds ? *target.seconds - spent : unlimited),
      budget_(target.seconds ? std::optional(seconds_) : std::nullopt), start_(Clock::now()) {}

void RunControl::continue_from(const Pilot& pilot) {
    inherited_passes_ = pilot.passes;
    Image mean, estimated;
    for (std::uint64_t pass = 0; pass < inherited_passes_; ++pass) {
        const PilotImages& images = pass < initial_pilot_passes ? pilot.initial : pilot.reduced;
        const auto before = static_cast<double>(pass);
        const auto with = [&](const Image& so_far, const ImagePair& parts) {
            return pass > 0 ? weighted_mean(so_far, before, parts[pass % 2], 1) : parts[pass % 2];
        };
        mean = with(mean, images.whole);
        estimated = with(estimated, images.estimated);
        add(mean, estimated);
    }
}

std::optional<PassPlan> RunControl::operator()(const PictureSoFar& so_far) {
    const std::uint64_t done = so_far.passes - inherited_passes_;
    if (done == 0) {
        budget_.start_pass();
    } else if (so_far.passes == halves_.next()) {
        const std::vector<Layer> layers = so_far.layers();
        add(layers.front().image, needs_estimated_light() ? estimated_light(layers) : Image());
    }
    if (target_.error && measured_) {
        question();
        if (outcome_ == RunOutcome::unfinished && may_switch_ && !measured_->testimony &&
            is_overdue()) {
            complete_witness();
        }
        if (outcome_ == RunOutcome::unfinished && witness_is_faster(done)) {
            outcome_ = RunOutcome::slow;
        }
        if (outcome_ != RunOutcome::unfinished) {
            return std::nullopt;
        }
    }
    if (target_.seconds && so_far.passes > 0 && !has_time(done)) {
        return std::nullopt;
    }
    const auto passes = static_cast<double>(so_far.passes);
    const double in_time = passes_in_time(done);
    const double expected = std::min(target_.error ? passes_to_target() : in_time, in_time);
    if (!target_.seconds && done > 0 &&
        takes_too_long((expected - static_cast<double>(inherited_passes_)) /
                       static_cast<double>(done))) {
        return std::nullopt;
    }
    expected_ = std::max(expected, passes + 1);
    return PassPlan{.expected = expected_, .stream = halves_.stream()};
}

/// Whether there is time for another pass. done: passes so far, without the pilot's.
bool RunControl::has_time(std::uint64_t done) {
    return done > 0 ? budget_.another(done, 0) : candidate_.seconds_per_pass <= seconds_;
}

/// Number of passes in all that fit into the budget. done: passes so far, without the pilot's.
double RunControl::passes_in_time(std::uint64_t done) const {
    if (!target_.seconds) {
        return unlimited;
    }
    const double own = done > 0
                           ? budget_.expected(done, 0)
                           : std::floor(seconds_ / std::max(candidate_.seconds_per_pass, 1e-6));
    return static_cast<double>(inherited_passes_) + own;
}

const MethodInfo& RunControl::method() const {
    return target_.methods.at(candidate_.settings.method);
}

/// Whether to read the estimated light. An unbiased witness measures its bias, now or later. If the
/// pilot was too short to fit a model, its noise tells which bias is usual.
bool RunControl::needs_estimated_light() const {
    return (witness_ && witness_->is_unbiased()) || !std::isfinite(model_.fixed);
}

/// Adds the images at the end of a turn of the halves.
void RunControl::add(const Image& mean_so_far, const Image& estimated_so_far) {
    halves_.add(mean_so_far);
    if (needs_estimated_light()) {
        estimated_.add(estimated_so_far);
    }
    if (halves_.both_have_passes()) {
        measure();
    }
}

void RunControl::measure() {
    const auto passes = static_cast<double>(halves_.passes());
    const ImagePair& means = halves_.means();
    const Image guess = passes < passes_for_pixels
                            ? guess_from({smoothed(means[0]), smoothed(means[1])})
                            : guess_from(means);
    if (!std::isfinite(model_.fixed)) {
        // The pilot was too short to fit a model.
        const PilotImages images{means, estimated_.means()};
        const double initial_passes = model_.initial_passes;
        model_ = model_of({.method = &method(),
                           .settings = candidate_.settings,
                           .passes = 2,
                           .initial = images,
                           .reduced = images},
                          nullptr, guess);
        model_.initial_passes = initial_passes;
    }
    measured_ = {.passes = passes, .noise = halves_.noise(guess)};
    const bool has_witness = witness_ && witness_->images() && target_.error;
    if (has_witness) {
        const Image seen = darkened_by(witness_->images()->whole, guess);
        variance_of_witness_ = witness_->variance_per_pass(seen);
        if (measured_->noise <= *target_.error) {
            const double bias = std::sqrt(bias_share(model_.law, passes, model_.initial_passes));
            measured_->testimony = witness_->testimony(means, bias, seen);
        }
    }
    measured_->bias = expected_bias(guess);
    is_doubtful_ = false;
    if (measured_->testimony) {
        is_doubtful_ = measured_->error() <= *target_.error;
        measured_->bias = judgement().bias();
    }
}

/// The bias that the error model expects and, as far as its noise allows, the truth about estimated
/// light measures.
Estimate RunControl::expected_bias(const Image& guess) const {
    const ImagePair* truth = witness_ ? witness_->truth() : nullptr;
    return truth ? bias_of(estimated_.means(), model_, measured_->passes, *truth, guess)
                 : bias_after(model_, measured_->passes);
}

/// Requires a testimony.
Judgement RunControl::judgement() const {
    return {usual_bias_after(model_, measured_->passes), *measured_->testimony,
            tolerance * *target_.error - measured_->noise};
}

/// Lets the witness decide whether the error is as small as it seems: renders more of it until it
/// confirms or refutes that, or has no more time.
void RunControl::question() {
    while (measured_->error() <= *target_.error || is_doubtful_) {
        if (!witness_) {
            outcome_ = RunOutcome::reached;
            return;
        }
        double more = 0;
        if (measured_->testimony) {
            const Judgement now = judgement();
            more = witness_->passes_missing();
            if (more == 0 && now.verdict() == Verdict::confirmed &&
                measured_->error() <= *target_.error) {
                outcome_ = RunOutcome::reached;
            }
            if (more == 0 && now.verdict() != Verdict::open) {
                return;
            }
            more = std::max(more, (now.growth() - 1) * witness_->passes());
        }
        if (!ask_witness(more)) {
            outcome_ = RunOutcome::unconfirmed;
            return;
        }
        measure();
    }
}

/// Renders more passes of the witness. Returns false if there is no time for them, or the user has
/// interrupted it.
bool RunControl::ask_witness(double passes) {
    const double left = seconds_of_witness_left();
    return left > 2 * witness_->seconds_per_pass() && budget_.once([&] {
        return witness_->render_more(passes, left, std::max(expected_, measured_->passes));
    });
}

double RunControl::seconds_of_witness_left() const {
    const double elapsed = seconds_since(start_);
    if (target_.seconds) {
        return seconds_ - elapsed;
    }
    const double others = spent_ + elapsed - witness_->seconds();
    return std::min(std::max(most_of_witness * others, seconds_of_witness) - witness_->seconds(),
                    default_time_limit - elapsed);
}

/// Seconds of the render so far, without those of its witness.
double RunControl::own_seconds() const {
    return seconds_since(start_) - (witness_ ? witness_->seconds() : 0);
}

/// Whether the render takes so many more passes than promised that its error model is not to be
/// believed. A pilot that rare bright photons have missed promises too much.
bool RunControl::is_overdue() const {
    return measured_->passes > most_of_promise * candidate_.passes && own_seconds() > least_overdue;
}

/// Renders enough of an unbiased witness to know how long its method would take.
void RunControl::complete_witness() {
    if (witness_ && witness_->is_unbiased() && witness_->passes_missing() > 0 &&
        ask_witness(witness_->passes_missing())) {
        measure();
    }
}

/// Whether the method of the witness reaches the target error sooner: because the witness has
/// measured much bias, or because the render is overdue. done: passes so far, without the pilot's.
bool RunControl::witness_is_faster(std::uint64_t done) const {
    if (!may_switch_ || !witness_ || !witness_->is_unbiased() || !(variance_of_witness_ > 0) ||
        !(measured_->testimony || (is_overdue() && witness_->passes_missing() == 0))) {
        return false;
    }
    const double each =
        done > 0 ? own_seconds() / static_cast<double>(done) : candidate_.seconds_per_pass;
    double more = (passes_to_target() - measured_->passes) * each;
    if (is_overdue()) {
        // Nothing better is known of it than that it takes as long again.
        more = std::max(more, own_seconds());
    }
    const double left = target_.seconds ? seconds_ - seconds_since(start_) : default_time_limit;
    const double other = of_witness().seconds;
    return other < more && other <= left;
}

Candidate RunControl::of_witness() const {
    Candidate c{.settings = witness_->pass(),
                .model = {.fixed = variance_of_witness_, .law = {}},
                .seconds_per_pass = witness_->seconds_per_pass()};
    c.passes = std::max(std::ceil(passes_for(c.model, *target_.error)), 2.0);
    c.seconds = c.passes * c.seconds_per_pass;
    c.error = error_after(c.model, c.passes);
    return c;
}

/// Number of passes in all that reach the target error. Scales the model to the measured noise,
/// because that of the pilot may be off.
double RunControl::passes_to_target() const {
    if (!measured_) {
        return candidate_.passes;
    }
    const double off = measured_->noise / std::max(noise_after(model_, measured_->passes), 1e-30);
    ErrorModel model = model_;
    model.fixed *= off;
    model.density *= off;
    model.bias = scaled(measured_->bias,
                        1 / bias_share(model_.law, measured_->passes, model_.initial_passes));
    return passes_for(model, *target_.error);
}

/// Whether `times` the elapsed time exceeds the limit.
bool RunControl::takes_too_long(double times) const {
    return measured_ && times * seconds_since(start_) > default_time_limit;
}

} // namespace argand
