#include "autotune/pilots.hpp"

#include "image/mean.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace argand {

namespace {

// To the error, up to which narrow passes of the pilot would be too much of the work.
constexpr double few_passes = 24;

bool is_path(const Pilot& pilot) { return pilot.method->abilities.unbiased; }

bool takes_few_passes(const Pilot& pilot, const Aim& aim) {
    return pilot.passes > 1 && aim.error &&
           passes_for(model_of(pilot, nullptr, best_guess({&pilot, 1})), *aim.error) <= few_passes;
}

} // namespace

RenderResult Pilots::run(const RenderSettings& settings, double seconds, const GoOn& go_on) {
    std::optional<PilotCourse> pilot; // until it is complete
    pilot.emplace(aim_.methods.at(settings.method), settings, [&](const Pilot& so_far) {
        return so_far.seconds > seconds || takes_few_passes(so_far, aim_);
    });
    OnPass next;
    RenderResult result =
        render_(settings, [&](const PictureSoFar& so_far) -> std::optional<PassPlan> {
            if (pilot) {
                if (const std::optional<PassPlan> plan = (*pilot)(so_far)) {
                    return plan;
                }
                add(std::move(*pilot).take());
                pilot.reset();
                next = go_on();
            }
            return next ? next(so_far) : std::nullopt;
        });
    // There may be no random numbers for more passes.
    if (pilot && !result.statistics.interrupted) {
        add(std::move(*pilot).take());
    }
    if (!next) {
        look_ahead(false);
    }
    return result;
}

bool Pilots::improve_truth(double seconds) {
    const auto path = std::find_if(pilots_.begin(), pilots_.end(), is_path);
    if (path == pilots_.end()) {
        return true;
    }
    RenderSettings more = path->settings;
    const double samples =
        std::floor(seconds / (pilot_passes * path->seconds_per_pass)) * more.samples;
    if (samples < 1) {
        return true;
    }
    more.samples = static_cast<std::uint32_t>(std::min(samples, 65'536.0));
    more.seed += 1;
    PilotCourse course(*path->method, more, [](const Pilot&) { return false; });
    if (render_(more, std::ref(course)).statistics.interrupted) {
        return false;
    }
    const Pilot pilot = std::move(course).take();
    add_truth(pilot);
    seconds_ += pilot.seconds;
    learn();
    look_ahead(false);
    return true;
}

std::size_t Pilots::count(const std::string& method) const {
    return static_cast<std::size_t>(
        std::count_if(pilots_.begin(), pilots_.end(),
                      [&](const Pilot& pilot) { return pilot.settings.method == method; }));
}

bool Pilots::last_is_best() const {
    const RenderSettings &last = pilots_.back().settings, &best = prospects_.front().settings;
    return last.method == best.method && last.samples == best.samples &&
           last.photons == best.photons;
}

void Pilots::add(Pilot pilot) {
    if (is_path(pilot)) {
        add_truth(pilot);
    }
    seconds_ += pilot.seconds;
    pilots_.push_back(std::move(pilot));
    learn();
    look_ahead(true);
}

void Pilots::learn() {
    const Image guess = best_guess(pilots_);
    models_.clear();
    for (const Pilot& pilot : pilots_) {
        models_.push_back(model_of(pilot, truth_ ? &*truth_ : nullptr, guess));
    }
}

void Pilots::look_ahead(bool last_goes_on) {
    prospects_.clear();
    for (std::size_t i = 0; i < pilots_.size(); ++i) {
        const bool goes_on = last_goes_on && i + 1 == pilots_.size();
        if (!is_path(pilots_[i]) || with_path_) {
            prospects_.push_back(prospect_of(pilots_[i], models_[i], aim_, seconds_, goes_on));
        }
    }
    std::sort(prospects_.begin(), prospects_.end(),
              [&](const Prospect& a, const Prospect& b) { return is_better(a, b, aim_); });
}

/// By its samples; its wide and narrow pictures are alike.
void Pilots::add_truth(const Pilot& path) {
    if (path.passes < wide_passes) {
        return;
    }
    const double samples = static_cast<double>(path.passes) * path.settings.samples;
    const Pair &a = path.wide.estimated, &b = path.narrow.estimated;
    const Pair more{mean_of(a[0], b[0]), mean_of(a[1], b[1])};
    truth_ = truth_ ? Pair{weighted_mean((*truth_)[0], truth_samples_, more[0], samples),
                           weighted_mean((*truth_)[1], truth_samples_, more[1], samples)}
                    : more;
    truth_samples_ += samples;
}

} // namespace argand
