#include "autotune/pilots.hpp"

#include "image/mean.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace argand {

namespace {

// In a render of at most this many passes, the pilot's passes at the reduced bandwidth would take
// too large a share of the time.
constexpr double few_passes = 24;

bool is_unbiased(const Pilot& pilot) { return pilot.method->abilities.unbiased; }

bool takes_few_passes(const Pilot& pilot, const Target& target) {
    return pilot.passes > 1 && target.error &&
           passes_for(model_of(pilot, nullptr, best_guess({&pilot, 1})), *target.error) <=
               few_passes;
}

} // namespace

Picture Pilots::run(const RenderSettings& settings, double seconds,
                    const Continuation& continuation) {
    std::optional<PilotControl> pilot; // empty once the pilot is complete
    pilot.emplace(target_.methods.at(settings.method), settings, [&](const Pilot& so_far) {
        return so_far.seconds > seconds || takes_few_passes(so_far, target_);
    });
    OnPass next;
    Picture picture{.result = {}, .settings = settings};
    picture.result = render_(settings, [&](const PictureSoFar& so_far) -> std::optional<PassPlan> {
        if (pilot) {
            if (const std::optional<PassPlan> plan = (*pilot)(so_far)) {
                return plan;
            }
            add(std::move(*pilot).take());
            pilot.reset();
            picture.pilot = pilots_.size() - 1;
            next = continuation();
        }
        return next ? next(so_far) : std::nullopt;
    });
    if (pilot) {
        // Interrupted, or there are no random numbers for more passes.
        Pilot ended = std::move(*pilot).take();
        if (picture.is_interrupted()) {
            picture.error = error_of_unfinished(ended);
        } else {
            add(std::move(ended));
            picture.pilot = pilots_.size() - 1;
        }
    }
    if (!next) {
        rank_candidates(false);
    }
    return picture;
}

std::optional<Picture> Pilots::improve_truth(double seconds) {
    const auto unbiased = std::find_if(pilots_.begin(), pilots_.end(), is_unbiased);
    if (unbiased == pilots_.end()) {
        return std::nullopt;
    }
    RenderSettings more = unbiased->settings;
    const double samples =
        std::floor(seconds / (pilot_passes * unbiased->seconds_per_pass)) * more.samples;
    if (samples < 1) {
        return std::nullopt;
    }
    more.samples = static_cast<std::uint32_t>(std::min(samples, 65'536.0));
    more.seed += 1;
    PilotControl control(*unbiased->method, more, [](const Pilot&) { return false; });
    Picture picture{.result = render_(more, std::ref(control)), .settings = more};
    const Pilot pilot = std::move(control).take();
    picture.error = error_of_unfinished(pilot);
    if (!picture.is_interrupted()) {
        add_truth(pilot);
        seconds_ += pilot.seconds;
        fit_models();
        rank_candidates(false);
    }
    return picture;
}

std::size_t Pilots::count(const std::string& method) const {
    return static_cast<std::size_t>(
        std::count_if(pilots_.begin(), pilots_.end(),
                      [&](const Pilot& pilot) { return pilot.settings.method == method; }));
}

void Pilots::add(Pilot pilot) {
    if (is_unbiased(pilot)) {
        add_truth(pilot);
    }
    seconds_ += pilot.seconds;
    pilots_.push_back(std::move(pilot));
    fit_models();
    rank_candidates(true);
}

void Pilots::fit_models() {
    guess_ = best_guess(pilots_);
    models_.clear();
    for (const Pilot& pilot : pilots_) {
        models_.push_back(fitted_to(pilot, guess_));
    }
}

ErrorModel Pilots::fitted_to(const Pilot& pilot, const Image& guess) const {
    return model_of(pilot, truth_.images ? &truth_.images->estimated : nullptr, guess);
}

bool Pilots::tells_error(const Pilot& pilot) const {
    return pilot.passes >= 2 && (!is_unbiased(pilot) || with_unbiased_);
}

std::optional<MeasuredError> Pilots::error_of(std::size_t pilot) const {
    if (!tells_error(pilots_[pilot])) {
        return std::nullopt;
    }
    return argand::error_of(pilots_[pilot], models_[pilot], guess_);
}

/// The same of a pilot that is none of these.
std::optional<MeasuredError> Pilots::error_of_unfinished(const Pilot& pilot) const {
    if (!tells_error(pilot)) {
        return std::nullopt;
    }
    const Image guess = pilots_.empty() ? best_guess({&pilot, 1}) : guess_;
    return argand::error_of(pilot, fitted_to(pilot, guess), guess);
}

void Pilots::rank_candidates(bool last_continues) {
    candidates_.clear();
    for (std::size_t i = 0; i < pilots_.size(); ++i) {
        const bool continues_pilot = last_continues && i + 1 == pilots_.size();
        if (!is_unbiased(pilots_[i]) || with_unbiased_) {
            candidates_.push_back(
                candidate_for(pilots_[i], models_[i], target_, seconds_, continues_pilot));
        }
    }
    std::sort(candidates_.begin(), candidates_.end(),
              [&](const Candidate& a, const Candidate& b) { return is_better(a, b, target_); });
}

/// Adds the images of an unbiased pilot to the truth, weighted by their samples. Its initial and
/// reduced passes are alike, as it has no bandwidth.
void Pilots::add_truth(const Pilot& unbiased) {
    if (unbiased.passes < initial_pilot_passes) {
        return;
    }
    const double samples = static_cast<double>(unbiased.passes) * unbiased.settings.samples;
    const auto mean = [](const ImagePair& a, const ImagePair& b) {
        return ImagePair{mean_of(a[0], b[0]), mean_of(a[1], b[1])};
    };
    truth_.add({.whole = mean(unbiased.initial.whole, unbiased.reduced.whole),
                .estimated = mean(unbiased.initial.estimated, unbiased.reduced.estimated),
                .caustic = mean(unbiased.initial.caustic, unbiased.reduced.caustic)},
               samples, unbiased.seconds);
}

} // namespace argand
