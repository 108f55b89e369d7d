#pragma once

#include "methods/method.hpp"
#include "shared/random.h"

#include <cstdint>
#include <map>

namespace argand {

/// Hands out random numbers to passes, by stream. Passes of one stream continue one quasi-random
/// sequence, whose points are better distributed together than apart, so their errors are not
/// independent. The errors of different streams are.
class Streams {
public:
    explicit Streams(std::uint32_t seed) : seed_(seed) {}

    /// passes_per_seed: see Method. When a seed has no more numbers, the stream goes on with
    /// another one: the same points, scrambled anew.
    PassNumbers next(std::uint32_t stream, std::uint64_t passes_per_seed) {
        constexpr std::uint32_t golden_ratio =
            0x9e3779b9u; // far from the small seeds that users choose
        const std::uint64_t index = counts_[stream]++;
        const std::uint32_t seed = seed_ + stream * golden_ratio;
        const std::uint64_t round = index / passes_per_seed;
        if (round == 0) {
            return {.seed = seed, .index = index};
        }
        const glm::uvec4 hash = pcg4d({seed, static_cast<std::uint32_t>(round),
                                       static_cast<std::uint32_t>(round >> 32), 0x5eed5u});
        return {.seed = hash.x, .index = index % passes_per_seed};
    }

    /// Saves or loads how many passes each stream has had.
    void persist(Archive& archive) {
        std::vector<std::uint64_t> words; // stream and count in turn
        for (const auto& [stream, count] : counts_) {
            words.push_back(stream);
            words.push_back(count);
        }
        archive.values(words);
        counts_.clear();
        for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
            counts_[static_cast<std::uint32_t>(words[i])] = words[i + 1];
        }
    }

private:
    std::uint32_t seed_;
    std::map<std::uint32_t, std::uint64_t> counts_;
};

} // namespace argand
