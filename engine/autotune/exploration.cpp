#include "autotune/exploration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {

namespace {

// Of what is to be spent in all, what pilots may take: of another method, of more photons a pass.
constexpr double share_of_pilots = 0.2;
constexpr double share_of_refinement = 0.1;
// Photons of a pass, and about as many eye paths, fewer than which do not fill a device.
constexpr std::uint64_t few_photons = 50'000;
constexpr std::uint32_t most_few_samples = 16;
// Of what makes more of the noise there is more in a pass, so many times at most; of eye paths no
// more than leave pilots.
constexpr std::uint64_t times_photons = 4;
constexpr double times_samples = 16;
constexpr double pilots_in_all = 2;

std::uint32_t few_samples(const RenderSettings& base) {
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(base.width) * static_cast<std::uint64_t>(base.height);
    return static_cast<std::uint32_t>(
        std::min<std::uint64_t>((few_photons + pixels - 1) / pixels, most_few_samples));
}

RenderSettings settings_of_pass(const RenderSettings& base, const Chosen& chosen,
                                const std::string& method) {
    RenderSettings pass = base;
    pass.budget.reset();
    pass.method = method;
    pass.samples = chosen.samples ? base.samples : few_samples(base);
    pass.photons = chosen.photons ? base.photons : few_photons;
    pass.photons_per_pass =
        std::max<std::uint64_t>(std::min(pass.photons, base.photons_per_pass), 1);
    return pass;
}

/// Eye paths in a pass, over those of the prospect, that make no more of the noise than photons do.
std::uint32_t times_more_samples(const Prospect& prospect) {
    const double direct = prospect.model.fixed + prospect.model.density - prospect.model.estimated;
    const double pilots = prospect.passes / static_cast<double>(pilot_passes);
    const double times = std::min({direct / std::max(prospect.model.estimated, 1e-30),
                                   pilots / pilots_in_all, times_samples});
    return std::isfinite(prospect.passes) && times >= 2 ? static_cast<std::uint32_t>(times) : 1;
}

} // namespace

std::optional<RenderSettings> Exploration::next() const {
    if (pilots.prospects().empty()) {
        return settings_of_pass(base, chosen, first_method());
    }
    // Paths tell the bias of the others as well, but for what they cannot find.
    const MethodInfo* unbiased = aim.methods.unbiased();
    if (path_is_true && unbiased && is_worth(*unbiased)) {
        return of_method(unbiased->name);
    }
    const Prospect& best = pilots.prospects().front();
    const bool is_refined = pilots.count(best.settings.method) > 1 ||
                            aim.methods.at(best.settings.method).abilities.unbiased;
    const std::uint32_t times = chosen.samples || is_refined ? 1 : times_more_samples(best);
    RenderSettings more = best.settings;
    if (times > 1) {
        more.samples *= times;
        return more;
    }
    for (const MethodInfo& method : aim.methods) {
        if (!chosen.method && method.trial == TrialOrder::later && is_worth(method)) {
            return of_method(method.name);
        }
    }
    const bool photons_rule = best.model.fixed + best.model.density < 2 * best.model.estimated;
    if (!is_refined && photons_rule && !chosen.photons && has_time(share_of_refinement)) {
        more.photons = more.photons_per_pass = times_photons * more.photons;
        return more;
    }
    return std::nullopt;
}

RenderSettings Exploration::of_method(const std::string& method) const {
    RenderSettings other = settings_of_pass(base, chosen, method);
    other.samples = pilots.last().settings.samples;
    return other;
}

std::string Exploration::first_method() const {
    const auto first =
        std::find_if(aim.methods.begin(), aim.methods.end(),
                     [](const MethodInfo& method) { return method.trial == TrialOrder::first; });
    return chosen.method || first == aim.methods.end() ? base.method : first->name;
}

bool Exploration::is_worth(const MethodInfo& method) const {
    return method.abilities.resumable && pilots.count(method.name) == 0 &&
           has_time(share_of_pilots);
}

double Exploration::most_seconds() const {
    // Later ones are known to be worth their time.
    const bool is_first = pilots.prospects().empty();
    return is_first && aim.seconds ? share_of_pilots * *aim.seconds
                                   : std::numeric_limits<double>::infinity();
}

/// One more pilot will take about as long as those before.
bool Exploration::has_time(double share) const {
    const double one_more = pilots.seconds() + pilots.seconds_each();
    return one_more <=
           share * (aim.seconds ? *aim.seconds : pilots.prospects().front().seconds + one_more);
}

} // namespace argand
