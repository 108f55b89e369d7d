#include "tradeoff/aim.hpp"

#include <cmath>
#include <fmt/format.h>

namespace argand {

namespace {

std::string counted(double count, const char* one, const char* many) {
    return fmt::format("{:L} {}", std::round(count), count < 1.5 ? one : many);
}

std::string numbers_of(const RenderSettings& settings) {
    const std::string photons = settings.method == "path" ? "" : fmt::format("{} photons and ", settings.photons);
    return fmt::format("{}{} a pixel in a pass", photons, counted(settings.samples, "sample", "samples"));
}

std::string error_of(const Prospect& prospect) {
    return std::isfinite(prospect.error) ? fmt::format("relMSE {:.2g}", prospect.error) : "unknown error, for want of time";
}

} // namespace

std::string describe_pick(const AimedRender& render) {
    const Prospect& best = render.prospects.front();
    std::string text = fmt::format("{}, {}: {} expected after {}, in {:.2g} s{}", best.settings.method,
                                   numbers_of(best.settings), error_of(best), counted(best.passes, "pass", "passes"),
                                   best.seconds, best.goes_on ? " more" : "");
    for (std::size_t i = 1; i < render.prospects.size(); ++i) {
        const Prospect& other = render.prospects[i];
        text += i == 1 ? "; not " : ", ";
        text += other.settings.method == best.settings.method ? numbers_of(other.settings) : other.settings.method;
        const bool by_time = reaches(best, render.aim) && reaches(other, render.aim);
        text += by_time ? fmt::format(" ({:.2g} s)", other.seconds) : fmt::format(" ({})", error_of(other));
    }
    return text + fmt::format("; pilots took {:.2g} s", render.pilot_seconds);
}

std::string describe_outcome(const AimedRender& render) {
    const bool missed = render.aim.error && !render.reached;
    const std::string lacking =
        missed ? fmt::format("; the {:.2g} asked for is not reached", *render.aim.error) : std::string();
    if (!render.measured) {
        return "its error is unknown: it takes two passes to measure noise" + lacking;
    }
    return fmt::format("relMSE about {:.2g}: noise {:.2g}, squared bias {:.2g}{}", render.measured->error(),
                       render.measured->noise, render.measured->bias.value, lacking);
}

} // namespace argand
