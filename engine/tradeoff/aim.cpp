#include "tradeoff/aim.hpp"

#include "base/error.hpp"
#include "plan/plan.hpp"
#include "tradeoff/pilots.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <initializer_list>
#include <limits>

namespace argand {

namespace {

using Clock = std::chrono::steady_clock;

// Of what is to be spent in all, what pilots may take: of another method, of other numbers of photons.
constexpr double share_of_pilots = 0.2;
constexpr double share_of_refinement = 0.1;
constexpr double share_of_truth = 0.1;
// Photons of a pass, and about as many eye paths, fewer than which do not fill a device. What makes more of the noise is tried
// with more of it.
constexpr std::uint64_t few_photons = 50'000;
constexpr std::uint32_t most_few_samples = 16;
constexpr std::uint32_t times_more = 4;
const std::vector<std::string> tried_methods{"photons", "path", "footprints"};

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::uint32_t few_samples(const RenderSettings& base) {
    const std::uint64_t pixels = static_cast<std::uint64_t>(base.width) * static_cast<std::uint64_t>(base.height);
    return static_cast<std::uint32_t>(std::min<std::uint64_t>((few_photons + pixels - 1) / pixels, most_few_samples));
}

RenderSettings settings_of_pass(const RenderSettings& base, const Chosen& chosen, const std::string& method) {
    RenderSettings pass = base;
    pass.budget.reset();
    pass.method = chosen.method ? base.method : method;
    pass.samples = chosen.samples ? base.samples : few_samples(base);
    pass.photons = chosen.photons ? base.photons : few_photons;
    pass.photons_per_pass = std::max<std::uint64_t>(std::min(pass.photons, base.photons_per_pass), 1);
    return pass;
}

/// Runs the pilots that are worth their time. Returns false if it was interrupted.
bool explore(Pilots& pilots, const RenderSettings& base, const Chosen& chosen, const Aim& aim, bool path_is_true) {
    const auto best = [&]() -> const Prospect& { return pilots.prospects().front(); };
    // One more pilot will take about as long as those before.
    const auto is_worth = [&](double share) {
        const double one_more = pilots.seconds() + pilots.seconds_each();
        return one_more <= share * (aim.seconds ? *aim.seconds : best().seconds + one_more);
    };
    const double first_seconds = aim.seconds ? share_of_pilots * *aim.seconds : std::numeric_limits<double>::infinity();
    if (!pilots.run(settings_of_pass(base, chosen, tried_methods.front()), first_seconds)) {
        return false;
    }
    Chosen numbers = chosen;
    numbers.method = false;
    for (const std::string& method : tried_methods) {
        // Paths tell the bias of the others as well, but for what they cannot find.
        const bool wanted = method == "path" ? path_is_true : !chosen.method;
        if (wanted && !pilots.has(method) && is_worth(share_of_pilots) &&
            !pilots.run(settings_of_pass(base, numbers, method))) {
            return false;
        }
    }
    const ErrorModel& model = best().model;
    const bool eye_paths_rule = model.fixed + model.density > 2 * model.estimated;
    const bool is_chosen = eye_paths_rule ? chosen.samples : chosen.photons;
    if (best().settings.method == "path" || is_chosen || !is_worth(share_of_refinement)) {
        return true;
    }
    RenderSettings more = best().settings;
    if (eye_paths_rule) {
        more.samples *= times_more;
    } else {
        more.photons = more.photons_per_pass = times_more * more.photons;
    }
    return pilots.run(more);
}

} // namespace

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
    // Final gather is not for path, so that it is not what was asked for.
    Pilots pilots(render, aim, chosen.method ? base.method == "path" : !base.final_gather);
    AimedRender aimed{.aim = aim};
    if (!explore(pilots, base, chosen, aim, path_is_true)) {
        aimed.result.statistics.interrupted = true;
        return aimed;
    }
    const Prospect& quickest = pilots.prospects().front();
    if (aim.error && !aim.seconds && !(quickest.seconds <= most_seconds)) {
        fail("rendering '{}' to a relMSE of {:.3g}: '{}', the quickest way, would take {:.3g} s; ask for more error, or say "
             "with --budget how long it may take", scene.name, *aim.error, quickest.settings.method, quickest.seconds);
    }
    if (quickest.settings.method != "path" && !pilots.improve_truth(share_of_truth * quickest.seconds)) {
        aimed.result.statistics.interrupted = true;
        return aimed;
    }
    aimed.prospects = pilots.prospects();
    aimed.pilot_seconds = seconds_since(start);
    const Prospect& best = aimed.prospects.front();
    on_pick(aimed);
    Course course(aim, best, pilots.truth(), seconds_since(start));
    aimed.result = render(best.settings, std::ref(course));
    aimed.measured = course.measured();
    aimed.reached = course.reached();
    return aimed;
}

} // namespace argand
