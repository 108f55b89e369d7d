#include "autotune/course.hpp"

#include "image/mean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {

namespace {

// From which on single pixels tell what relMSE divides by; before, a penumbra may be black in one
// half of the passes.
constexpr double passes_for_pixels = 16;
constexpr double unlimited = std::numeric_limits<double>::infinity();

} // namespace

Course::Course(const Aim& aim, const Prospect& prospect, const std::optional<Pair>& truth,
               double spent)
    : aim_(aim), prospect_(prospect), truth_(truth), model_(prospect.model),
      seconds_(aim.seconds ? *aim.seconds - spent : unlimited),
      budget_(aim.seconds ? std::optional(seconds_) : std::nullopt), start_(Clock::now()) {}

void Course::go_on_from(const Pilot& pilot) {
    begun_ = pilot.passes;
    Image mean, estimated;
    for (std::uint64_t pass = 0; pass < begun_; ++pass) {
        const PilotPictures& pictures = pass < wide_passes ? pilot.wide : pilot.narrow;
        const auto before = static_cast<double>(pass);
        const auto with = [&](const Image& so_far, const Pair& parts) {
            return pass > 0 ? weighted_mean(so_far, before, parts[pass % 2], 1) : parts[pass % 2];
        };
        mean = with(mean, pictures.whole);
        estimated = with(estimated, pictures.estimated);
        add(mean, estimated);
    }
}

std::optional<PassPlan> Course::operator()(const PictureSoFar& so_far) {
    const std::uint64_t done = so_far.passes - begun_;
    if (done == 0) {
        budget_.start_pass();
    } else if (so_far.passes == halves_.next()) {
        const std::vector<Layer> layers = so_far.layers();
        add(layers.front().image, asks_estimated() ? estimated_light(layers) : Image());
    }
    if (aim_.error && measured_ && measured_->error() <= *aim_.error) {
        reached_ = true;
        return std::nullopt;
    }
    if (aim_.seconds && so_far.passes > 0 && !has_time(done)) {
        return std::nullopt;
    }
    const auto passes = static_cast<double>(so_far.passes);
    const double in_time = passes_in_time(done);
    const double expected = std::min(aim_.error ? to_error() : in_time, in_time);
    if (!aim_.seconds && done > 0 &&
        takes_too_long((expected - static_cast<double>(begun_)) / static_cast<double>(done))) {
        return std::nullopt;
    }
    return PassPlan{.expected = std::max(expected, passes + 1), .stream = halves_.stream()};
}

/// Whether there is time for another pass after so many of its own.
bool Course::has_time(std::uint64_t done) {
    return done > 0 ? budget_.another(done, 0) : prospect_.seconds_per_pass <= seconds_;
}

/// Passes in all, after so many of its own.
double Course::passes_in_time(std::uint64_t done) const {
    if (!aim_.seconds) {
        return unlimited;
    }
    const double own = done > 0 ? budget_.expected(done, 0)
                                : std::floor(seconds_ / std::max(prospect_.seconds_per_pass, 1e-6));
    return static_cast<double>(begun_) + own;
}

const MethodInfo& Course::method() const { return aim_.methods.at(prospect_.settings.method); }

bool Course::tells_bias() const { return !method().abilities.unbiased && truth_; }

/// Noise of estimated light tells what bias is usual, where the pilot was too short.
bool Course::asks_estimated() const { return tells_bias() || !std::isfinite(model_.fixed); }

/// At the end of a turn of the halves.
void Course::add(const Image& mean_so_far, const Image& estimated_so_far) {
    halves_.add(mean_so_far);
    if (asks_estimated()) {
        estimated_.add(estimated_so_far);
    }
    if (halves_.are_two()) {
        measure();
    }
}

void Course::measure() {
    const auto passes = static_cast<double>(halves_.passes());
    const Pair& means = halves_.means();
    const Image guess = passes < passes_for_pixels
                            ? guess_from({smoothed(means[0]), smoothed(means[1])})
                            : guess_from(means);
    if (!std::isfinite(model_.fixed)) {
        // What the pilot was too short to tell.
        const PilotPictures pictures{means, estimated_.means()};
        const double wide = model_.wide;
        model_ = model_of({.method = &method(),
                           .settings = prospect_.settings,
                           .passes = 2,
                           .wide = pictures,
                           .narrow = pictures},
                          nullptr, guess);
        model_.wide = wide;
    }
    measured_ = {.passes = passes,
                 .noise = halves_.noise(guess),
                 .bias = tells_bias() ? bias_of(estimated_.means(), model_, passes, *truth_, guess)
                                      : bias_after(model_, passes)};
}

/// Passes in all, from the noise that is measured: the pilot's may be off.
double Course::to_error() const {
    if (!measured_) {
        return prospect_.passes;
    }
    const double off = measured_->noise / std::max(noise_after(model_, measured_->passes), 1e-30);
    ErrorModel model = model_;
    model.fixed *= off;
    model.density *= off;
    model.bias =
        scaled(measured_->bias, 1 / bias_share(model_.law, measured_->passes, model_.wide));
    return passes_for(model, *aim_.error);
}

/// Whether so many times what was done so far does.
bool Course::takes_too_long(double times) const {
    return measured_ && times * seconds_since(start_) > most_seconds;
}

} // namespace argand
