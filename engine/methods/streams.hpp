#pragma once

#include <cstdint>
#include <map>

namespace argand {

/// The random numbers of a pass.
struct PassNumbers {
    std::uint32_t seed = 0;
    std::uint64_t index = 0; ///< of the pass among those of this seed
};

/// Hands out random numbers to passes, by stream. Passes of one stream continue one quasi-random
/// sequence, whose points are better distributed together than apart, so their errors are not
/// independent. The errors of different streams are.
class Streams {
public:
    explicit Streams(std::uint32_t seed) : seed_(seed) {}

    PassNumbers next(std::uint32_t stream) {
        constexpr std::uint32_t golden_ratio =
            0x9e3779b9u; // far from the small seeds that users choose
        return {.seed = seed_ + stream * golden_ratio, .index = counts_[stream]++};
    }

private:
    std::uint32_t seed_;
    std::map<std::uint32_t, std::uint64_t> counts_;
};

} // namespace argand
