#include "autotune/run_control.hpp"

#include "image/mean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {

namespace {

// From this number of passes on, the denominator of relMSE follows from single pixels alone.
constexpr double passes_for_pixels = 16;
constexpr double unlimited = std::numeric_limits<double>::infinity();
// A witness confirms that the error is at most so many times the target error.
constexpr double tolerance = 1.5;
// Without a time budget a witness may take this many times as long as all else, and at least these
// seconds.
constexpr double most_of_witness = 2, seconds_of_witness = 2;
// A render that could not be confirmed goes on to so many times the passes at most.
constexpr double most_of_doubt = 2;
// A render is overdue after so many times the promised passes, and at least these seconds.
constexpr double most_of_promise = 2, least_overdue = 2;
// Of default_time_limit: a render that has taken less, and has few passes, is not given up. One
// firefly in its first passes may have as much noise as all pixels will have in an hour.
constexpr double least_of_limit = 0.1;
// Caustics that make up less than this share of the picture, as relMSE without them, need no
// witness of their own.
constexpr double least_caustics = 1e-4;

ImagePair difference(const ImagePair& a, const ImagePair& b) {
    return {weighted_sum(a[0], 1, b[0], -1), weighted_sum(a[1], 1, b[1], -1)};
}

bool are_worth_judging(const ImagePair& caustics, const Image& guess) {
    const Image black = weighted_sum(guess, 0, guess, 0);
    return squared_difference(caustics, {black, black}, guess)[0].value > least_caustics;
}

} // namespace

RunControl::RunControl(const Target& target, const Candidate& candidate, const Witnesses& witnesses,
                       bool may_switch, double spent)
    : target_(target), candidate_(candidate), witness_(witnesses.picture),
      caustic_witness_(witnesses.caustics), may_switch_(may_switch), spent_(spent),
      model_(candidate.model), seconds_(target.seconds ? *target.seconds - spent : unlimited),
      budget_(target.seconds ? std::optional(seconds_) : std::nullopt), start_(Clock::now()) {}

void RunControl::continue_from(const Pilot& pilot) {
    inherited_passes_ = pilot.passes;
    Image mean, estimated, caustic;
    for (std::uint64_t pass = 0; pass < inherited_passes_; ++pass) {
        const PilotImages& images = pass < initial_pilot_passes ? pilot.initial : pilot.reduced;
        const auto before = static_cast<double>(pass);
        const auto with = [&](const Image& so_far, const ImagePair& parts) {
            return pass > 0 ? weighted_mean(so_far, before, parts[pass % 2], 1) : parts[pass % 2];
        };
        mean = with(mean, images.whole);
        estimated = with(estimated, images.estimated);
        caustic = with(caustic, images.caustic);
        add(mean, estimated, caustic);
    }
}

std::optional<PassPlan> RunControl::operator()(const PictureSoFar& so_far) {
    const std::uint64_t done = so_far.passes - inherited_passes_;
    if (done == 0) {
        budget_.start_pass();
    } else if (so_far.passes == halves_.next()) {
        const std::vector<Layer> layers = so_far.layers();
        add(layers.front().image, needs_estimated_light() ? estimated_light(layers) : Image(),
            caustic_witness_ ? caustic_light(layers) : Image());
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
        outcome_ = RunOutcome::too_long;
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
void RunControl::add(const Image& mean_so_far, const Image& estimated_so_far,
                     const Image& caustic_so_far) {
    halves_.add(mean_so_far);
    if (needs_estimated_light()) {
        estimated_.add(estimated_so_far);
    }
    if (caustic_witness_) {
        caustic_.add(caustic_so_far);
    }
    if (halves_.both_have_passes()) {
        measure();
    }
}

Image RunControl::guess_of(const ImagePair& images) const {
    return static_cast<double>(halves_.passes()) < passes_for_pixels ? guess_from_few(images)
                                                                     : guess_from(images);
}

void RunControl::measure() {
    const auto passes = static_cast<double>(halves_.passes());
    const ImagePair& means = halves_.means();
    const Image guess = guess_of(means);
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
    if (witness_ && witness_->images() && target_.error) {
        hear_witnesses(guess);
    }
    measured_->bias = expected_bias(guess);
    is_doubtful_ = false;
    if (measured_->testimony) {
        is_doubtful_ = measured_->error() <= *target_.error;
        measured_->bias = judgement().bias();
    }
}

/// Sets the testimony, if the noise alone does not exceed the target error. guess: for the
/// denominator of relMSE.
void RunControl::hear_witnesses(const Image& guess) {
    const ImagePair& means = halves_.means();
    const PilotImages& seen = *witness_->images();
    variance_of_witness_ = witness_->variance_per_pass(darkened_by(seen.whole, guess));
    if (!(measured_->noise <= *target_.error)) {
        return;
    }
    const double bias = std::sqrt(bias_share(model_.law, measured_->passes, model_.initial_passes));
    judges_caustics_ = caustic_witness_ && are_worth_judging(caustic_.means(), guess);
    if (!judges_caustics_ || !caustic_witness_->images()) {
        measured_->testimony = witness_->testimony(means, bias, darkened_by(seen.whole, guess));
        return;
    }
    const ImagePair &caustics = caustic_.means(), &narrow = caustic_witness_->images()->caustic;
    const ImagePair others = difference(means, caustics),
                    judges = difference(seen.whole, seen.caustic);
    const Image sharp = sharpened_by(narrow, mean_of(caustics[0], caustics[1]));
    const Image reference = weighted_sum(darkened_by(judges, guess_of(others)), 1, sharp, 1);
    measured_->noise = halves_.noise(reference);
    Testimony said = testimony_on(others, judges, 1, reference);
    said.caustics = caustic_witness_->testimony_on_caustics(caustics, bias, reference);
    measured_->testimony = said;
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
        doubted_since_ = doubted_since_ > 0 ? doubted_since_ : measured_->passes;
        if (!witness_) {
            outcome_ = RunOutcome::reached;
            return;
        }
        if (measured_->testimony && all_witnesses_have_spoken()) {
            const Verdict verdict = judgement().verdict();
            if (verdict == Verdict::confirmed && measured_->error() <= *target_.error) {
                outcome_ = RunOutcome::reached;
            }
            if (verdict != Verdict::open) {
                return;
            }
        }
        const Request next = next_request();
        if (!has_time_for(*next.witness)) {
            outcome_ = may_go_on_in_doubt() ? RunOutcome::unfinished : RunOutcome::unconfirmed;
            return;
        }
        if (!ask(next)) {
            outcome_ = RunOutcome::unconfirmed;
            return;
        }
        measure();
    }
}

/// Whether to render more while the witness has no time, if that is not the end of the budget. A
/// picture of less noise is easier to confirm, and where the picture may have too much error, more
/// of it is an answer anyway.
bool RunControl::may_go_on_in_doubt() const {
    const bool speaks_against =
        measured_->testimony && all_witnesses_have_spoken() && judgement().speaks_against();
    return !target_.seconds && (speaks_against || measured_->error() > *target_.error ||
                                measured_->passes < most_of_doubt * doubted_since_);
}

/// Whether the testimony counts: fewer passes may have missed rare paths, or all caustics.
bool RunControl::all_witnesses_have_spoken() const {
    return witness_->passes_missing() == 0 && !(judges_caustics_ && !caustic_witness_->images());
}

/// What is needed most to tell.
RunControl::Request RunControl::next_request() const {
    if (!measured_->testimony || witness_->passes_missing() > 0) {
        return {witness_, witness_->images() ? witness_->passes_missing() : 0};
    }
    if (!all_witnesses_have_spoken()) {
        return {caustic_witness_, 0};
    }
    const Judgement now = judgement();
    Witness* noisier = now.caustics_are_in_doubt() ? caustic_witness_ : witness_;
    return {noisier, (now.growth() - 1) * noisier->passes()};
}

bool RunControl::has_time_for(const Witness& witness) const {
    // Kernels and the scene are set up anew for it: a short time is not worth that.
    constexpr double least_share = 0.25;
    return seconds_of_witness_left() >
           std::max(2 * witness.seconds_per_pass(), least_share * witness.seconds());
}

/// Renders more passes of a witness. Returns false if the user has interrupted it.
bool RunControl::ask(const Request& request) {
    is_interrupted_ = !budget_.once([&] {
        return request.witness->render_more(request.passes, seconds_of_witness_left(),
                                            std::max(expected_, measured_->passes));
    });
    return !is_interrupted_;
}

double RunControl::seconds_of_witnesses() const {
    return (witness_ ? witness_->seconds() : 0) +
           (caustic_witness_ ? caustic_witness_->seconds() : 0);
}

double RunControl::seconds_of_witness_left() const {
    const double elapsed = seconds_since(start_);
    if (target_.seconds) {
        return seconds_ - elapsed;
    }
    const double others = spent_ + elapsed - seconds_of_witnesses();
    return std::min(std::max(most_of_witness * others, seconds_of_witness) - seconds_of_witnesses(),
                    default_time_limit - elapsed);
}

/// Seconds of the render so far, without those of its witnesses.
double RunControl::own_seconds() const { return seconds_since(start_) - seconds_of_witnesses(); }

/// Whether the render takes so many more passes than promised that its error model is not to be
/// believed. A pilot that rare bright photons have missed promises too much.
bool RunControl::is_overdue() const {
    return measured_->passes > most_of_promise * candidate_.passes && own_seconds() > least_overdue;
}

/// Renders enough of an unbiased witness to know how long its method would take.
void RunControl::complete_witness() {
    if (witness_ && witness_->is_unbiased() && witness_->passes_missing() > 0 &&
        has_time_for(*witness_) && ask({witness_, witness_->passes_missing()})) {
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

/// Whether `times` the elapsed time exceeds the limit, as far as that can be told by now.
bool RunControl::takes_too_long(double times) const {
    const double elapsed = seconds_since(start_);
    const bool is_known = measured_ && (measured_->passes >= passes_for_pixels ||
                                        elapsed > least_of_limit * default_time_limit);
    return is_known && times * elapsed > default_time_limit;
}

} // namespace argand
