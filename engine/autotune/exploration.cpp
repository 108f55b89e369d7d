#include "autotune/exploration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {

namespace {

// Largest share of the total time that all pilots may take if the next one tries another method, or
// more photons per pass.
constexpr double share_of_pilots = 0.2;
constexpr double share_of_refinement = 0.1;
// Photons of a pass, and about its number of eye paths. Fewer would not fill a device.
constexpr std::uint64_t few_photons = 50'000;
constexpr std::uint32_t most_few_samples = 16;
// Caps how far a pass scales up whichever dominates the noise, photons or eye paths. With more eye
// paths the render must still be as long as `pilots_in_render` pilots.
constexpr std::uint64_t times_photons = 4;
constexpr double times_samples = 16;
constexpr double pilots_in_render = 2;

std::uint32_t few_samples(const RenderSettings& base) {
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(base.width) * static_cast<std::uint64_t>(base.height);
    return static_cast<std::uint32_t>(
        std::min<std::uint64_t>((few_photons + pixels - 1) / pixels, most_few_samples));
}

RenderSettings settings_of_pass(const RenderSettings& base, const UserSet& user_set,
                                const std::string& method) {
    RenderSettings pass = base;
    pass.budget.reset();
    pass.method = method;
    pass.samples = user_set.samples ? base.samples : few_samples(base);
    pass.photons = user_set.photons ? base.photons : few_photons;
    pass.photons_per_pass =
        std::max<std::uint64_t>(std::min(pass.photons, base.photons_per_pass), 1);
    return pass;
}

/// Factor by which to raise the candidate's eye paths per pass, so that they make no more of the
/// noise than photons do.
std::uint32_t times_more_samples(const Candidate& candidate) {
    const double direct =
        candidate.model.fixed + candidate.model.density - candidate.model.estimated;
    const double pilots = candidate.passes / static_cast<double>(pilot_passes);
    const double times = std::min({direct / std::max(candidate.model.estimated, 1e-30),
                                   pilots / pilots_in_render, times_samples});
    return std::isfinite(candidate.passes) && times >= 2 ? static_cast<std::uint32_t>(times) : 1;
}

} // namespace

std::optional<RenderSettings> Exploration::next_pilot() const {
    if (pilots.candidates().empty()) {
        return settings_of_pass(base, user_set, first_method());
    }
    // Path tracing also measures the bias of the other methods, unless it misses some light.
    const MethodInfo* unbiased = target.methods.unbiased();
    const bool user_chose_unbiased = user_set.method && pilots.with_unbiased();
    if (eye_paths_find_all && unbiased && !user_chose_unbiased && is_worth_trying(*unbiased)) {
        return of_method(unbiased->name);
    }
    const Candidate& best = pilots.candidates().front();
    const bool is_refined = pilots.count(best.settings.method) > 1 ||
                            target.methods.at(best.settings.method).abilities.unbiased;
    const std::uint32_t times = user_set.samples || is_refined ? 1 : times_more_samples(best);
    RenderSettings more = best.settings;
    if (times > 1) {
        more.samples *= times;
        return more;
    }
    for (const MethodInfo& method : target.methods) {
        if (!user_set.method && method.trial == TrialOrder::later && is_worth_trying(method)) {
            return of_method(method.name);
        }
    }
    const bool photons_rule = best.model.fixed + best.model.density < 2 * best.model.estimated;
    if (!is_refined && photons_rule && !user_set.photons && has_time(share_of_refinement)) {
        more.photons = more.photons_per_pass = times_photons * more.photons;
        return more;
    }
    return std::nullopt;
}

RenderSettings Exploration::short_pass(const MethodInfo& unbiased) const {
    return settings_of_pass(base, {}, unbiased.name);
}

RenderSettings Exploration::of_method(const std::string& method) const {
    RenderSettings other = settings_of_pass(base, user_set, method);
    other.samples = pilots.last().settings.samples;
    return other;
}

std::string Exploration::first_method() const {
    const MethodInfo* first = target.methods.tried_first();
    return user_set.method || !first ? base.method : first->name;
}

bool Exploration::is_worth_trying(const MethodInfo& method) const {
    return pilots.count(method.name) == 0 && has_time(share_of_pilots);
}

double Exploration::pilot_time_limit() const {
    // Later pilots run only if they are worth their time.
    const bool is_first = pilots.candidates().empty();
    return is_first && target.seconds ? share_of_pilots * *target.seconds
                                      : std::numeric_limits<double>::infinity();
}

/// Whether one more pilot, expected to take as long as the average one, keeps all pilots within
/// this share of the total time.
bool Exploration::has_time(double share) const {
    const double one_more = pilots.seconds() + pilots.seconds_each();
    return one_more <= share * (target.seconds ? *target.seconds
                                               : pilots.candidates().front().seconds + one_more);
}

} // namespace argand
