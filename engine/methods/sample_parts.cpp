#include "methods/sample_parts.hpp"

#include <algorithm>

namespace argand {

SampleParts divide_samples(const RenderSettings& settings, const EyeWorkspace& workspace,
                           std::uint32_t samples) {
    SampleParts parts{.count = 1, .samples = samples};
    if (settings.budget || settings.least_passes > 1 || settings.variance ||
        samples <= settings.samples_per_pass) {
        return parts;
    }
    const std::uint32_t together = samples_together(workspace, samples, true);
    parts.samples =
        std::min(std::max(settings.samples_per_pass / together, 1u) * together, samples);
    parts.count = (std::uint64_t(samples) + parts.samples - 1) / parts.samples;
    return parts;
}

EyePass part_of(const EyePass& whole, const SampleParts& parts, std::uint64_t part) {
    EyePass result = whole;
    const auto before = static_cast<std::uint32_t>(part * parts.samples);
    result.first_sample += before;
    result.samples_of_all = whole.samples;
    result.samples = std::min(parts.samples, whole.samples - before);
    return result;
}

} // namespace argand
