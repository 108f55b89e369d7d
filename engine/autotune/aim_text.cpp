#include "autotune/aim.hpp"

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

std::string error_of(const Prospect& prospect) {
    return std::isfinite(prospect.error) ? fmt::format("relMSE {:.2g}", prospect.error)
                                         : "unknown error";
}

} // namespace

std::string describe_pick(const AimedRender& render) {
    const Prospect& best = render.prospects.front();
    std::string text = fmt::format(
        "{}, {}: {} after {}, in {:.2g} s{}, expected", best.settings.method,
        numbers_of(best.settings, render.aim.methods), error_of(best),
        counted(best.passes, "pass", "passes"), best.seconds, best.goes_on ? " more" : "");
    std::map<std::string, int> counts;
    for (const Prospect& prospect : render.prospects) {
        ++counts[prospect.settings.method];
    }
    for (std::size_t i = 1; i < render.prospects.size(); ++i) {
        const Prospect& other = render.prospects[i];
        text += i == 1 ? "; not " : ", ";
        text += counts[other.settings.method] > 1
                    ? fmt::format("{}, {}", other.settings.method,
                                  numbers_of(other.settings, render.aim.methods))
                    : other.settings.method;
        const bool by_time = reaches(best, render.aim) && reaches(other, render.aim);
        text += by_time ? fmt::format(" ({:.2g} s)", other.seconds)
                        : fmt::format(" ({})", error_of(other));
    }
    return text + fmt::format("; pilots took {:.2g} s", render.pilot_seconds);
}

std::string describe_outcome(const AimedRender& render) {
    const bool missed = render.aim.error && !render.reached;
    const std::string lacking =
        missed ? fmt::format("; the {:.2g} asked for is not reached", *render.aim.error)
               : std::string();
    if (render.prospects.empty()) {
        return "its error is unknown: it was interrupted while methods were tried";
    }
    if (!render.measured) {
        return "its error is unknown: it takes two whole passes to measure noise" + lacking;
    }
    return fmt::format("relMSE about {:.2g}: noise {:.2g}, squared bias {:.2g}{}",
                       render.measured->error(), render.measured->noise,
                       render.measured->bias.value, lacking);
}

} // namespace argand
