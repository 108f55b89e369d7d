#pragma once

#include <cstdint>
#include <map>

namespace argand {

/// Which random numbers a pass takes.
struct PassNumbers {
    std::uint32_t seed = 0;
    std::uint64_t index = 0; ///< of the pass among those of the seed
};

/// Counts passes by stream. Those of one stream continue one sequence of numbers, which are better
/// distributed together than apart, so that their errors are not independent; those of different
/// streams are.
class Streams {
public:
    explicit Streams(std::uint32_t seed) : seed_(seed) {}

    PassNumbers next(std::uint32_t stream) {
        constexpr std::uint32_t golden_ratio = 0x9e3779b9u; // far from the seeds that users count
        return {.seed = seed_ + stream * golden_ratio, .index = counts_[stream]++};
    }

private:
    std::uint32_t seed_;
    std::map<std::uint32_t, std::uint64_t> counts_;
};

} // namespace argand
