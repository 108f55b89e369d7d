#include "tradeoff/aim.hpp"

#include "base/error.hpp"
#include "image/mean.hpp"
#include "methods/budget.hpp"
#include "plan/plan.hpp"
#include "tradeoff/halves.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace argand {

namespace {

using Clock = std::chrono::steady_clock;

// Of what is to be spent in all, what pilots may take: of another method, of other numbers of photons.
constexpr double share_of_pilots = 0.2;
constexpr double share_of_refinement = 0.1;
constexpr double share_of_truth = 0.1;
// From which on single pixels tell what relMSE divides by; before, a penumbra may be black in one half of the passes.
constexpr double passes_for_pixels = 16;
// What sweeps find on the front (docs/results/tradeoff_*.csv): one sample a pass, with photons few or many.
constexpr std::uint64_t few_photons = 50'000;
constexpr std::uint64_t many_photons = 200'000;
const std::vector<std::string> tried_methods{"photons", "path", "footprints"};

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

RenderSettings settings_of_pass(const RenderSettings& base, const Chosen& chosen, const std::string& method,
                                std::uint64_t photons) {
    RenderSettings pass = base;
    pass.budget.reset();
    pass.method = chosen.method ? base.method : method;
    pass.samples = chosen.samples ? base.samples : 1;
    pass.photons = chosen.photons ? base.photons : photons;
    pass.photons_per_pass = std::max<std::uint64_t>(std::min(pass.photons, base.photons_per_pass), 1);
    return pass;
}

/// Passes, time and error of a pilot's settings: to the error, or in what is left of the time.
Prospect prospect_of(const Pilot& pilot, const ErrorModel& model, const Aim& aim, double spent) {
    Prospect p{.settings = pilot.settings, .model = model, .seconds_per_pass = pilot.seconds_per_pass};
    const double each = std::max(pilot.seconds_per_pass, 1e-6);
    // Noise is measured from two passes at least.
    const double wanted = aim.error ? std::max(std::ceil(passes_for(model, *aim.error)), 2.0) : 1e9;
    const double possible = aim.seconds ? std::max(std::floor((*aim.seconds - spent) / each), 1.0) : 1e9;
    p.passes = std::min(wanted, possible);
    p.seconds = p.passes * each;
    p.error = error_after(model, p.passes);
    return p;
}

/// Which of two is better: the one that reaches the error, then the sooner; of those that do not, the one with less.
bool is_better(const Prospect& a, const Prospect& b, const Aim& aim) {
    if (reaches(a, aim) != reaches(b, aim)) {
        return reaches(a, aim);
    }
    return reaches(a, aim) ? a.seconds < b.seconds : a.error < b.error;
}

/// Pilots and what follows from them.
class Pilots {
public:
    /// with_path: path is one of the ways; without, it only tells the others' bias.
    Pilots(const RenderPasses& render, const Aim& aim, bool with_path)
        : render_(render), aim_(aim), with_path_(with_path) {}

    /// Returns false if it was interrupted.
    bool run(const RenderSettings& settings) {
        std::optional<Pilot> pilot = run_pilot(render_, settings);
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

    /// More samples of path, which tell the others' bias, for so many seconds. Returns false if it was interrupted.
    bool improve_truth(double seconds) {
        const Pilot* path = find("path");
        if (!path) {
            return true;
        }
        RenderSettings more = path->settings;
        const double samples = std::floor(seconds / (4 * path->seconds_per_pass)) * more.samples;
        if (samples < 1) {
            return true;
        }
        more.samples = static_cast<std::uint32_t>(std::min(samples, 65'536.0));
        more.seed += 1;
        const std::optional<Pilot> pilot = run_pilot(render_, more);
        if (pilot) {
            add_truth(*pilot);
            seconds_ += pilot->seconds;
            look_ahead();
        }
        return pilot.has_value();
    }

    const std::optional<Pair>& truth() const { return truth_; }

    bool has(const std::string& method) const { return find(method) != nullptr; }

    double seconds() const { return seconds_; }
    double seconds_each() const { return seconds_ / static_cast<double>(pilots_.size()); }

    /// Best first.
    const std::vector<Prospect>& prospects() const { return prospects_; }

private:
    /// What follows from all pilots so far.
    void look_ahead() {
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

    const Pilot* find(const std::string& method) const {
        const auto found = std::find_if(pilots_.begin(), pilots_.end(),
                                        [&](const Pilot& pilot) { return pilot.settings.method == method; });
        return found == pilots_.end() ? nullptr : &*found;
    }

    /// Adds a pilot of path, whose wide and narrow pictures are alike, to the truth by its samples.
    void add_truth(const Pilot& pilot) {
        const double samples = pilot.settings.samples;
        const Pair &a = pilot.estimated_wide, &b = pilot.estimated_narrow;
        const Pair more{mean_of(a[0], b[0]), mean_of(a[1], b[1])};
        truth_ = truth_ ? Pair{weighted_mean((*truth_)[0], truth_samples_, more[0], samples),
                               weighted_mean((*truth_)[1], truth_samples_, more[1], samples)}
                        : more;
        truth_samples_ += samples;
    }

    const RenderPasses& render_;
    const Aim& aim_;
    bool with_path_;
    std::optional<Pair> truth_;
    double truth_samples_ = 0, seconds_ = 0;
    std::vector<Pilot> pilots_;
    std::vector<Prospect> prospects_;
};

/// Decides after each pass whether there is another, and measures the noise.
class Course {
public:
    Course(const Aim& aim, const Prospect& prospect, const std::optional<Pair>& truth, double spent)
        : aim_(aim), prospect_(prospect), truth_(truth), budget_(aim.seconds ? std::optional(*aim.seconds - spent) : std::nullopt) {}

    std::optional<PassPlan> operator()(const PictureSoFar& so_far) {
        if (so_far.passes == 0) {
            budget_.start_pass();
            return PassPlan{.expected = prospect_.passes};
        }
        if (so_far.passes == halves_.next()) {
            measure(so_far);
        }
        if (aim_.error && noise_ && *noise_ + bias_.value <= *aim_.error) {
            reached_ = true;
            return std::nullopt;
        }
        if (aim_.seconds && !budget_.another(so_far.passes, 0)) {
            return std::nullopt;
        }
        const auto done = static_cast<double>(so_far.passes);
        const double in_time = aim_.seconds ? budget_.expected(so_far.passes, 0) : 1e9;
        return PassPlan{.expected = std::max(std::min(aim_.error ? to_error() : in_time, in_time), done + 1),
                        .stream = halves_.stream()};
    }

    double noise() const { return noise_.value_or(0); }
    double bias() const { return bias_.value; }
    bool reached() const { return reached_; }

private:
    void measure(const PictureSoFar& so_far) {
        const std::vector<Layer> layers = so_far.layers();
        halves_.add(layers.front().image);
        estimated_.add(estimated_light(layers));
        if (!halves_.are_equal()) {
            return;
        }
        measured_ = static_cast<double>(so_far.passes);
        const Pair& means = halves_.means();
        const Image guess =
            measured_ < passes_for_pixels ? guess_from({smoothed(means[0]), smoothed(means[1])}) : guess_from(means);
        noise_ = halves_.noise(guess);
        bias_ = bias_after(prospect_.model, measured_);
        if (truth_ && prospect_.settings.method != "path") {
            bias_ = bias_of(estimated_.means(), *truth_, bias_share(measured_) * prospect_.model.usual_bias, guess);
        }
    }

    /// Passes in all, from the noise that is measured: the pilot's may be off.
    double to_error() const {
        if (!noise_) {
            return prospect_.passes;
        }
        const double off = *noise_ / std::max(noise_after(prospect_.model, measured_), 1e-30);
        return passes_for({.fixed = off * prospect_.model.fixed, .density = off * prospect_.model.density,
                           .bias = scaled(bias_, 1 / bias_share(measured_))}, *aim_.error);
    }

    const Aim& aim_;
    const Prospect& prospect_;
    const std::optional<Pair>& truth_;
    Budget budget_;
    Halves halves_, estimated_;     ///< of the whole picture, of its estimated light
    std::optional<double> noise_;
    double measured_ = 0;       ///< passes after which it was
    Estimate bias_{0, 0};
    bool reached_ = false;
};

/// Runs the pilots that are worth their time. Returns false if it was interrupted.
bool explore(Pilots& pilots, const RenderSettings& base, const Chosen& chosen, const Aim& aim, bool path_is_true) {
    // One more pilot will take about as long as those before.
    const auto is_worth = [&](double share) {
        const double one_more = pilots.seconds() + pilots.seconds_each();
        const double ahead = pilots.prospects().front().seconds;
        return one_more <= share * (aim.seconds ? *aim.seconds : ahead + one_more);
    };
    if (!pilots.run(settings_of_pass(base, chosen, tried_methods.front(), few_photons))) {
        return false;
    }
    Chosen numbers = chosen;
    numbers.method = false;
    for (const std::string& method : tried_methods) {
        // Paths tell the bias of the others as well, but for what they cannot find.
        const bool wanted = method == "path" ? path_is_true : !chosen.method;
        if (wanted && !pilots.has(method) && is_worth(share_of_pilots) &&
            !pilots.run(settings_of_pass(base, numbers, method, few_photons))) {
            return false;
        }
    }
    const auto best = [&]() -> const Prospect& { return pilots.prospects().front(); };
    if (!chosen.photons && best().settings.method != "path" && is_worth(share_of_refinement)) {
        RenderSettings many = best().settings;
        many.photons = many.photons_per_pass = many_photons;
        if (!pilots.run(many)) {
            return false;
        }
    }
    return best().settings.method == "path" || pilots.improve_truth(share_of_truth * best().seconds);
}

} // namespace

bool reaches(const Prospect& prospect, const Aim& aim) {
    // passes_for() is exact to a thousandth.
    return aim.error && prospect.error <= 1.01 * *aim.error;
}

bool is_blind_to_caustics(const Scene& scene) {
    const Plan plan = make_plan(scene, {});
    const auto needs_any = [&](std::initializer_list<Feature> features) {
        return std::any_of(features.begin(), features.end(), [&](Feature feature) { return plan.needs(feature); });
    };
    return needs_any({Feature::point_light, Feature::spot_light, Feature::directional_light}) &&
           needs_any({Feature::mirror, Feature::transmission, Feature::alpha});
}

AimedRender render_aimed(const RenderPasses& render, const Scene& scene, const RenderSettings& base, const Chosen& chosen,
                         const Aim& aim, const OnPick& on_pick) {
    const Clock::time_point start = Clock::now();
    const bool path_is_true = !is_blind_to_caustics(scene);
    if (chosen.method && base.method == "path" && !path_is_true) {
        fail("rendering '{}' to a relMSE: method 'path' does not find the light of lamps without extent by way of mirrors and "
             "glass, so its error does not fall; leave --method out", scene.name);
    }
    Pilots pilots(render, aim, !chosen.method || base.method == "path");
    AimedRender aimed{.aim = aim};
    if (!explore(pilots, base, chosen, aim, path_is_true)) {
        aimed.result.statistics.interrupted = true;
        return aimed;
    }
    aimed.prospects = pilots.prospects();
    aimed.pilot_seconds = seconds_since(start);
    const Prospect& best = aimed.prospects.front();
    if (aim.error && !aim.seconds && !(best.seconds <= most_seconds)) {
        fail("rendering '{}' to a relMSE of {:.3g}: '{}', the quickest way, would take {:.3g} s; ask for more error, or say "
             "with --budget how long it may take", scene.name, *aim.error, best.settings.method, best.seconds);
    }
    on_pick(aimed);
    Course course(aim, best, pilots.truth(), seconds_since(start));
    aimed.result = render(best.settings, std::ref(course));
    aimed.noise = course.noise();
    aimed.bias = course.bias();
    aimed.reached = course.reached();
    return aimed;
}

} // namespace argand
