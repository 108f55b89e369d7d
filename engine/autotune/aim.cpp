#include "autotune/aim.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "plan/plan.hpp"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <utility>

namespace argand {

namespace {

// Of what is to be spent in all, what more paths may take that only tell the bias of other methods.
constexpr double share_of_truth = 0.1;

} // namespace

bool is_blind_to_caustics(const Scene& scene) {
    const Plan plan = make_plan(scene, {});
    const auto needs_any = [&](std::initializer_list<Feature> features) {
        return std::any_of(features.begin(), features.end(),
                           [&](Feature feature) { return plan.needs(feature); });
    };
    return needs_any({Feature::point_light, Feature::spot_light, Feature::directional_light}) &&
           needs_any({Feature::mirror, Feature::transmission, Feature::alpha});
}

AimedRender render_aimed(const RenderPasses& render, const Scene& scene, const RenderSettings& base,
                         const Chosen& chosen, const Aim& aim, const OnPick& on_pick) {
    const Clock::time_point start = Clock::now();
    const bool path_is_true = !is_blind_to_caustics(scene);
    const auto is_unbiased = [&](const RenderSettings& settings) {
        return aim.methods.at(settings.method).abilities.unbiased;
    };
    const bool is_chosen = chosen.method && is_unbiased(base);
    if (is_chosen && !path_is_true) {
        fail("rendering '{}' to a relMSE: method '{}' does not find the light of lamps without "
             "extent by way of mirrors and "
             "glass, so its error does not fall; leave --method out",
             scene.name, base.method);
    }
    // Final gather is not for path, so that it is not what was asked for.
    Pilots pilots(render, aim, chosen.method ? is_chosen : !base.final_gather);
    const Exploration exploration{
        .pilots = pilots, .base = base, .chosen = chosen, .aim = aim, .path_is_true = path_is_true};
    AimedRender aimed{.aim = aim};
    std::optional<Course> course;
    const auto pick = [&] {
        const Prospect& best = pilots.prospects().front();
        if (aim.error && !aim.seconds && !(best.seconds <= most_seconds)) {
            fail("rendering '{}' to a relMSE of {:.3g}: '{}', the quickest way, would take {:.3g} "
                 "s; ask for more error, or say "
                 "with --budget how long it may take",
                 scene.name, *aim.error, best.settings.method, best.seconds);
        }
        aimed.prospects = pilots.prospects();
        aimed.settings = best.settings;
        aimed.pilot_seconds = seconds_since(start);
        on_pick(aimed);
        course.emplace(aim, aimed.prospects.front(), pilots.truth(), aimed.pilot_seconds);
    };
    const GoOn go_on = [&]() -> OnPass {
        const Prospect& best = pilots.prospects().front();
        // The others' bias is better known after more paths.
        const bool asks_truth = pilots.truth() && !is_unbiased(best.settings);
        if (!best.goes_on || asks_truth || exploration.next()) {
            return nullptr;
        }
        pick();
        course->go_on_from(pilots.last());
        return std::ref(*course);
    };
    while (!course) {
        const std::optional<RenderSettings> settings = exploration.next();
        if (!settings) {
            break;
        }
        RenderResult result = pilots.run(*settings, exploration.most_seconds(), go_on);
        const bool interrupted = result.statistics.interrupted;
        // The best pilot's picture is for those who do not wait for a better one.
        if (course ||
            (interrupted ? aimed.result.statistics.samples == 0 : pilots.last_is_best())) {
            aimed.result = std::move(result);
            aimed.settings = *settings;
        }
        if (interrupted) {
            aimed.result.statistics.interrupted = true;
            break;
        }
    }
    if (!course && !aimed.result.statistics.interrupted) {
        const Prospect& best = pilots.prospects().front();
        const bool asks_truth = !is_unbiased(best.settings) && best.seconds <= most_seconds;
        if (asks_truth && !pilots.improve_truth(share_of_truth * best.seconds)) {
            aimed.result.statistics.interrupted = true;
        } else {
            pick();
            aimed.result = render(aimed.settings, std::ref(*course));
        }
    }
    if (course) {
        aimed.measured = course->measured();
        aimed.reached = course->reached();
    }
    return aimed;
}

} // namespace argand
