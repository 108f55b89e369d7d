#include "tradeoff/pilots.hpp"

#include "image/mean.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace argand {

namespace {

// To the error, up to which narrow passes of the pilot would be too much of the work.
constexpr double few_passes = 24;

bool takes_few_passes(const Pilot& pilot, const Aim& aim) {
    return pilot.passes > 1 && aim.error &&
           passes_for(model_of(pilot, nullptr, best_guess({pilot})), *aim.error) <= few_passes;
}

} // namespace

bool Pilots::run(const RenderSettings& settings, double seconds) {
    std::optional<Pilot> pilot = run_pilot(render_, settings, [&](const Pilot& so_far) {
        return so_far.seconds > seconds || takes_few_passes(so_far, aim_);
    });
    if (!pilot) {
        return false;
    }
    if (pilot->settings.method == "path") {
        add_truth(*pilot);
    }
    seconds_ += pilot->seconds;
    pilots_.push_back(std::move(*pilot));
    look_ahead();
    return true;
}

bool Pilots::improve_truth(double seconds) {
    const Pilot* path = find("path");
    if (!path) {
        return true;
    }
    RenderSettings more = path->settings;
    const double samples = std::floor(seconds / (pilot_passes * path->seconds_per_pass)) * more.samples;
    if (samples < 1) {
        return true;
    }
    more.samples = static_cast<std::uint32_t>(std::min(samples, 65'536.0));
    more.seed += 1;
    const std::optional<Pilot> pilot = run_pilot(render_, more, [](const Pilot&) { return false; });
    if (pilot) {
        add_truth(*pilot);
        seconds_ += pilot->seconds;
        look_ahead();
    }
    return pilot.has_value();
}

const Pilot* Pilots::find(const std::string& method) const {
    const auto found =
        std::find_if(pilots_.begin(), pilots_.end(), [&](const Pilot& pilot) { return pilot.settings.method == method; });
    return found == pilots_.end() ? nullptr : &*found;
}

void Pilots::look_ahead() {
    const Image guess = best_guess(pilots_);
    prospects_.clear();
    for (const Pilot& pilot : pilots_) {
        if (pilot.settings.method != "path" || with_path_) {
            prospects_.push_back(prospect_of(pilot, model_of(pilot, truth_ ? &*truth_ : nullptr, guess), aim_, seconds_));
        }
    }
    std::sort(prospects_.begin(), prospects_.end(),
              [&](const Prospect& a, const Prospect& b) { return is_better(a, b, aim_); });
}

/// By its samples; its wide and narrow pictures are alike.
void Pilots::add_truth(const Pilot& path) {
    if (path.passes < pilot_passes / 2) {
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
