#include "autotune/autotune.hpp"

#include <cmath>
#include <fmt/format.h>
#include <map>

namespace argand {

namespace {

std::string counted(double count, const char* one, const char* many) {
    return fmt::format("{:L} {}", std::round(count), count < 1.5 ? one : many);
}

std::string numbers_of(const RenderSettings& settings, MethodTable methods) {
    const std::string photons = methods.at(settings.method).abilities.photon_map
                                    ? fmt::format("{} photons and ", settings.photons)
                                    : "";
    return fmt::format("{}{} a pixel in a pass", photons,
                       counted(settings.samples, "sample", "samples"));
}

/// What there is to say of the target error, as the end of a line. Empty without one.
std::string describe_target(const AutotunedRender& render) {
    if (!render.target.error) {
        return "";
    }
    std::string judge;
    if (!render.witness.empty()) {
        judge = fmt::format(" by '{}'", render.witness);
        if (!render.witness_of_caustics.empty()) {
            judge += fmt::format(" and, of caustics, narrow '{}'", render.witness_of_caustics);
        }
        judge += render.witness_seconds > 0 ? fmt::format(" in {:.2g} s", render.witness_seconds)
                                            : " of the pilots";
    }
    switch (render.outcome) {
    case RunOutcome::reached:
        return judge.empty() ? "" : "; confirmed" + judge;
    case RunOutcome::unconfirmed:
        return fmt::format("; the target of {:.2g} is not reached for certain: it could not be "
                           "confirmed{}",
                           *render.target.error, judge);
    case RunOutcome::too_long:
        return fmt::format("; the target of {:.2g} is not reached: it would take more than {:.0f} "
                           "s, so the best picture so far is kept; allow a larger error, or give "
                           "it a time with --budget",
                           *render.target.error, default_time_limit);
    default:
        return render.measured && render.measured->error() <= *render.target.error
                   ? fmt::format("; the target of {:.2g} is not reached for certain: nothing has "
                                 "confirmed it",
                                 *render.target.error)
                   : fmt::format("; the target of {:.2g} is not reached", *render.target.error);
    }
}

std::string error_of(const Candidate& candidate) {
    return std::isfinite(candidate.error) ? fmt::format("relMSE {:.2g}", candidate.error)
                                          : "unknown error";
}

} // namespace

std::string describe_pick(const AutotunedRender& render) {
    const Candidate& best = render.candidates.front();
    std::string text = fmt::format(
        "{}, {}: expects {} after {}, in {:.2g} s{}", best.settings.method,
        numbers_of(best.settings, render.target.methods), error_of(best),
        counted(best.passes, "pass", "passes"), best.seconds, best.continues_pilot ? " more" : "");
    std::map<std::string, int> counts;
    for (const Candidate& candidate : render.candidates) {
        ++counts[candidate.settings.method];
    }
    for (std::size_t i = 1; i < render.candidates.size(); ++i) {
        const Candidate& other = render.candidates[i];
        text += i == 1 ? "; not " : ", ";
        text += counts[other.settings.method] > 1
                    ? fmt::format("{}, {}", other.settings.method,
                                  numbers_of(other.settings, render.target.methods))
                    : other.settings.method;
        const bool by_time = reaches(best, render.target) && reaches(other, render.target);
        text += by_time ? fmt::format(" ({:.2g} s)", other.seconds)
                        : fmt::format(" ({})", error_of(other));
    }
    return text + fmt::format("; pilots took {:.2g} s", render.pilot_seconds);
}

std::string describe_outcome(const AutotunedRender& render) {
    const std::string missing = render.candidates.empty()
                                    ? "; it was interrupted while methods were tried"
                                    : describe_target(render);
    if (!render.measured) {
        return "its error is unknown: measuring noise takes two complete passes" + missing;
    }
    return fmt::format("relMSE about {:.2g}: noise {:.2g}, squared bias {:.2g}{}",
                       render.measured->error(), render.measured->noise,
                       render.measured->bias.value, missing);
}

} // namespace argand
