#include "tradeoff/course.hpp"

#include <algorithm>
#include <limits>

namespace argand {

namespace {

// From which on single pixels tell what relMSE divides by; before, a penumbra may be black in one half of the passes.
constexpr double passes_for_pixels = 16;
constexpr double unlimited = std::numeric_limits<double>::infinity();

} // namespace

Course::Course(const Aim& aim, const Prospect& prospect, const std::optional<Pair>& truth, double spent)
    : aim_(aim), prospect_(prospect), truth_(truth),
      budget_(aim.seconds ? std::optional(*aim.seconds - spent) : std::nullopt), start_(std::chrono::steady_clock::now()) {}

std::optional<PassPlan> Course::operator()(const PictureSoFar& so_far) {
    if (so_far.passes == 0) {
        budget_.start_pass();
        return PassPlan{.expected = prospect_.passes};
    }
    if (so_far.passes == halves_.next()) {
        measure(so_far);
    }
    if (aim_.error && measured_ && measured_->error() <= *aim_.error) {
        reached_ = true;
        return std::nullopt;
    }
    if (aim_.seconds && !budget_.another(so_far.passes, 0)) {
        return std::nullopt;
    }
    const auto done = static_cast<double>(so_far.passes);
    const double in_time = aim_.seconds ? budget_.expected(so_far.passes, 0) : unlimited;
    const double expected = std::min(aim_.error ? to_error() : in_time, in_time);
    if (!aim_.seconds && takes_too_long(expected / done)) {
        return std::nullopt;
    }
    return PassPlan{.expected = std::max(expected, done + 1), .stream = halves_.stream()};
}

void Course::measure(const PictureSoFar& so_far) {
    const std::vector<Layer> layers = so_far.layers();
    halves_.add(layers.front().image);
    const bool by_truth = truth_ && prospect_.settings.method != "path";
    if (by_truth) {
        estimated_.add(estimated_light(layers));
    }
    if (!halves_.are_equal()) {
        return;
    }
    const auto passes = static_cast<double>(so_far.passes);
    const Pair& means = halves_.means();
    const Image guess = passes < passes_for_pixels ? guess_from({smoothed(means[0]), smoothed(means[1])}) : guess_from(means);
    measured_ = {.passes = passes,
                 .noise = halves_.noise(guess),
                 .bias = by_truth ? bias_of(estimated_.means(), prospect_.model, passes, *truth_, guess)
                                  : bias_after(prospect_.model, passes)};
}

/// Passes in all, from the noise that is measured: the pilot's may be off.
double Course::to_error() const {
    if (!measured_) {
        return prospect_.passes;
    }
    const double off = measured_->noise / std::max(noise_after(prospect_.model, measured_->passes), 1e-30);
    return passes_for({.fixed = off * prospect_.model.fixed, .density = off * prospect_.model.density,
                       .bias = scaled(measured_->bias, 1 / bias_share(measured_->passes))}, *aim_.error);
}

/// Whether so many times what was done so far does.
bool Course::takes_too_long(double times) const {
    return measured_ && times * std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() > most_seconds;
}

} // namespace argand
