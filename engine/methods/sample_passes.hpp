#pragma once

#include "methods/method.hpp"

#include <algorithm>
#include <cstdint>

namespace argand {

/// How the samples of an image are spread over passes that share nothing but the film. After the
/// last pass of an image a further round of them begins.
struct SamplePasses {
    std::uint64_t samples = 1; ///< of each pixel in the image
    std::uint64_t of_pass = 1; ///< of all passes but a last, smaller one

    std::uint64_t count() const { return (samples + of_pass - 1) / of_pass; }

    /// Of the pass with this index.
    std::uint64_t first_sample(std::uint64_t index) const {
        return index / count() * samples + index % count() * of_pass;
    }
    std::uint32_t samples_of(std::uint64_t index) const {
        return static_cast<std::uint32_t>(std::min(of_pass, samples - index % count() * of_pass));
    }

    /// Passes for which one seed has numbers.
    std::uint64_t per_seed() const { return numbers_of_seed / samples * count(); }
};

/// most: samples of a pass at most, at least 1.
inline SamplePasses sample_passes(const RenderSettings& settings, std::uint64_t most) {
    SamplePasses passes{.samples = std::max(settings.samples, 1u)};
    const std::uint64_t spread =
        std::max<std::uint64_t>(passes.samples / std::max(settings.least_passes, 1u), 1);
    passes.of_pass =
        std::min<std::uint64_t>({spread, std::max(settings.samples_per_pass, 1u), most});
    return passes;
}

} // namespace argand
