#include "autotune/autotune.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "methods/plan_render.hpp"
#include "plan/plan.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace argand {

namespace {

// What decides between two pictures. A black pilot has no error that could be told, so 0 does not
// count.
double known_error(const Picture& picture) {
    const double error = picture.error ? picture.error->error() : 0;
    return std::isfinite(error) && error > 0 ? error : std::numeric_limits<double>::infinity();
}

// More paths that only measure the bias of other methods may take this share of the render's time.
constexpr double share_of_truth = 0.1;

/// One autotuned render: runs pilots until no further pilot pays off, picks the best candidate, and
/// renders it, either by continuing the last pilot or from the start.
class Autotuner {
public:
    Autotuner(const RenderPasses& render, const Scene& scene, Pilots& pilots,
              const Exploration& exploration, const OnPick& on_pick, Clock::time_point start)
        : render_(render), scene_(scene), pilots_(pilots), exploration_(exploration),
          on_pick_(on_pick), start_(start), tuned_{.target = exploration.target} {}

    AutotunedRender run() && {
        run_pilots();
        if (!control_ && !is_interrupted()) {
            render_best();
        }
        if (control_ && control_->outcome() == RunOutcome::slow && !is_interrupted()) {
            render_as_witness();
        }
        tuned_.result = std::move(best_so_far_->result);
        tuned_.settings = std::move(best_so_far_->settings);
        tuned_.measured = best_so_far_->error;
        if (control_) {
            tuned_.outcome = control_->outcome();
        }
        tell_of_witness();
        return std::move(tuned_);
    }

private:
    bool is_interrupted() const { return best_so_far_ && best_so_far_->is_interrupted(); }
    const Candidate& best() const { return pilots_.candidates().front(); }
    bool best_is_unbiased() const {
        return tuned_.target.methods.at(best().settings.method).abilities.unbiased;
    }

    /// Runs pilots until one of them continues as the final render, none is worth running, or the
    /// user interrupts.
    void run_pilots() {
        while (!control_ && !is_interrupted()) {
            const std::optional<RenderSettings> settings = exploration_.next_pilot();
            if (!settings) {
                return;
            }
            Picture picture = pilots_.run(*settings, exploration_.pilot_time_limit(),
                                          [&] { return continuation(); });
            keep(control_ ? final_picture(std::move(picture.result), *settings)
                          : std::move(picture));
        }
    }

    /// Sets the error of a complete pilot's picture, as far as it is known by now.
    void tell_error(Picture& picture) const {
        if (picture.pilot) {
            picture.error = pilots_.error_of(*picture.pilot);
        }
    }

    /// Keeps this picture if it is the final one, or the best so far for a user who interrupts, or
    /// for a render that is given up.
    void keep(Picture picture) {
        const bool interrupted = picture.is_interrupted();
        const bool is_final =
            control_ && !interrupted && control_->outcome() != RunOutcome::too_long;
        tell_error(picture);
        if (best_so_far_) {
            tell_error(*best_so_far_); // more is known by now
        }
        if (!best_so_far_ || is_final || known_error(picture) < known_error(*best_so_far_)) {
            best_so_far_ = std::move(picture);
        }
        best_so_far_->result.statistics.interrupted = interrupted;
    }

    Picture final_picture(RenderResult result, const RenderSettings& settings) const {
        result.statistics.interrupted = result.statistics.interrupted || control_->is_interrupted();
        return {.result = std::move(result), .settings = settings, .error = control_->measured()};
    }

    /// The final render from the start.
    void render_picked(const RenderSettings& settings) {
        keep(final_picture(render_(settings, std::ref(*control_)), settings));
    }

    /// Picks the last pilot and returns what controls its further passes. Returns null if its
    /// passes are to be thrown away, because another candidate is better or another pilot comes
    /// first.
    OnPass continuation() {
        // More paths measure the bias of other methods better.
        const bool needs_more_truth = pilots_.truth().images && !best_is_unbiased();
        if (!best().continues_pilot || needs_more_truth || exploration_.next_pilot()) {
            return nullptr;
        }
        pick();
        control_->continue_from(pilots_.last());
        return std::ref(*control_);
    }

    /// Picks the best candidate, tells the user, and sets up the control of its render.
    void pick() {
        const Target& target = tuned_.target;
        if (target.error && !target.seconds && !(best().seconds <= default_time_limit)) {
            fail(
                "rendering '{}' to a relMSE of {:.3g}: '{}', the fastest method, would take {:.3g} "
                "s; allow a larger error, or limit the time with --budget",
                scene_.name, *target.error, best().settings.method, best().seconds);
        }
        tuned_.candidates = pilots_.candidates();
        tuned_.pilot_seconds = seconds_since(start_);
        on_pick_(tuned_);
        call_witness();
        const Witnesses witnesses{.picture = witness_ ? &*witness_ : nullptr,
                                  .caustics = caustic_witness_ ? &*caustic_witness_ : nullptr};
        control_.emplace(target, tuned_.candidates.front(), witnesses, pilots_.with_unbiased(),
                         tuned_.pilot_seconds);
    }

    /// Prepares the witnesses of the best candidate, if it has bias: the unbiased method, and for
    /// caustics, which that finds by rare paths, narrow passes of the candidate itself. Where the
    /// unbiased method misses light, they judge all.
    void call_witness() {
        const MethodInfo* unbiased = tuned_.target.methods.unbiased();
        if (best_is_unbiased()) {
            return;
        }
        if (unbiased && exploration_.eye_paths_find_all) {
            witness_.emplace(render_, *unbiased, exploration_.short_pass(*unbiased));
            if (plan_render(scene_, best().settings, tuned_.target.methods)
                    .needs(Feature::caustics)) {
                caustic_witness_.emplace(render_, tuned_.target.methods.at(best().settings.method),
                                         best().settings, times_passes_of_caustics);
            }
        } else {
            witness_.emplace(render_, tuned_.target.methods.at(best().settings.method),
                             best().settings);
        }
        const PooledImages& truth = pilots_.truth();
        if (truth.images && witness_->is_unbiased()) {
            witness_->add(*truth.images, truth.samples, truth.seconds);
        }
    }

    /// Tells who judged the result.
    void tell_of_witness() {
        if (!witness_) {
            return;
        }
        tuned_.witness_seconds = witness_->seconds();
        if (caustic_witness_ && caustic_witness_->images()) {
            tuned_.witness_seconds += caustic_witness_->seconds();
            tuned_.witness_of_caustics = caustic_witness_->pass().method;
        }
        // The result of a render that went on with the witness's method has no bias to judge.
        const bool is_judged = tuned_.measured && tuned_.measured->testimony;
        if (is_judged || tuned_.outcome == RunOutcome::unconfirmed) {
            tuned_.witness = witness_->pass().method;
        }
    }

    /// Renders again from the start, with the method of the witness.
    void render_as_witness() {
        Candidate& left = tuned_.candidates.front();
        left.error = control_->measured()->error();
        tuned_.candidates.insert(tuned_.candidates.begin(), control_->of_witness());
        on_pick_(tuned_);
        control_.emplace(tuned_.target, tuned_.candidates.front(), Witnesses(), false,
                         seconds_since(start_));
        render_picked(tuned_.candidates.front().settings);
    }

    /// Renders the best candidate from the start, after more paths where they improve the estimate
    /// of its bias.
    void render_best() {
        const bool needs_more_truth = !best_is_unbiased() && best().seconds <= default_time_limit;
        if (needs_more_truth) {
            if (std::optional<Picture> truth =
                    pilots_.improve_truth(share_of_truth * best().seconds)) {
                keep(*std::move(truth));
            }
        }
        if (!is_interrupted()) {
            pick();
            render_picked(tuned_.candidates.front().settings);
        }
    }

    const RenderPasses& render_;
    const Scene& scene_;
    Pilots& pilots_;
    const Exploration& exploration_;
    const OnPick& on_pick_;
    Clock::time_point start_;
    AutotunedRender tuned_;
    std::optional<Picture> best_so_far_;     ///< once there is one; at last the result
    std::optional<Witness> witness_;         ///< of the final render, if its method has bias
    std::optional<Witness> caustic_witness_; ///< if eye paths find caustics, but only rarely
    std::optional<RunControl> control_;      ///< of the final render, once it is picked
};

} // namespace

AutotunedRender autotune(const RenderPasses& render, const Scene& scene, const RenderSettings& base,
                         const UserSet& user_set, const Target& target, const OnPick& on_pick) {
    const Clock::time_point start = Clock::now();
    const bool eye_paths_find_all = !is_blind_to_caustics(scene);
    const bool user_wants_unbiased =
        user_set.method && target.methods.at(base.method).abilities.unbiased;
    if (user_wants_unbiased && !eye_paths_find_all) {
        fail("rendering '{}' to a relMSE: method '{}' misses the caustics of delta lights "
             "(mirrors and glass), so its error does not converge; leave --method out",
             scene.name, base.method);
    }
    // Without a final gather of its own, the unbiased method does not render what the user asked
    // for.
    const MethodInfo* unbiased = target.methods.unbiased();
    const bool renders_request =
        !base.final_gather || (unbiased != nullptr && unbiased->option("final-gather") != nullptr);
    Pilots pilots(render, target, user_set.method ? user_wants_unbiased : renders_request);
    const Exploration exploration{.pilots = pilots,
                                  .base = base,
                                  .user_set = user_set,
                                  .target = target,
                                  .eye_paths_find_all = eye_paths_find_all};
    return Autotuner(render, scene, pilots, exploration, on_pick, start).run();
}

} // namespace argand
