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

} // namespace

RunControl::RunControl(const Target& target, const Candidate& candidate,
                       const std::optional<ImagePair>& truth, double spent)
    : target_(target), candidate_(candidate), truth_(truth), model_(candidate.model),
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
    if (target_.error && measured_ && measured_->error() <= *target_.error) {
        reached_ = true;
        return std::nullopt;
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
    return PassPlan{.expected = std::max(expected, passes + 1), .stream = halves_.stream()};
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

bool RunControl::measures_bias() const { return !method().abilities.unbiased && truth_; }

/// Whether to read the estimated light. If the pilot was too short to fit a model, its noise tells
/// which bias is usual.
bool RunControl::needs_estimated_light() const {
    return measures_bias() || !std::isfinite(model_.fixed);
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
    measured_ = {.passes = passes,
                 .noise = halves_.noise(guess),
                 .bias = measures_bias()
                             ? bias_of(estimated_.means(), model_, passes, *truth_, guess)
                             : bias_after(model_, passes)};
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
