#include "methods/photon_numbers.hpp"

#include "methods/method.hpp"
#include "shared/random.h"
#include "shared/sampling.h"

#include <vector>

namespace argand {

PhotonPass PhotonNumbers::next(std::uint32_t seed, std::uint64_t count) {
    constexpr std::uint64_t round = 1ull << 32;
    std::uint64_t& next = next_[seed];
    if (next % round + count > numbers_of_seed) {
        next = (next / round + 1) * round;
    }
    const std::uint64_t rounds = next / round, first = next % round;
    next += count;
    // Not the hash by which Streams (session/streams.hpp) choose another seed for whole passes.
    const std::uint32_t of_round =
        rounds == 0 ? seed
                    : pcg4d({seed, static_cast<std::uint32_t>(rounds),
                             static_cast<std::uint32_t>(rounds >> 32), 0x9407025u})
                          .x;
    return {.seed = of_round, .first = first, .count = count, .bounces = 0};
}

std::uint32_t kind_of_photon_numbers(const RenderSettings& settings) {
    if (settings.deterministic) {
        return numbers_lattice;
    }
    return settings.photon_sampling == Sampling::sobol ? numbers_sobol : numbers_hashed;
}

void PhotonNumbers::persist(Archive& archive) {
    std::vector<std::uint64_t> words; // seed and next number in turn
    words.reserve(2 * next_.size());
    for (const auto& [seed, next] : next_) {
        words.push_back(seed);
        words.push_back(next);
    }
    archive.values(words);
    next_.clear();
    for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
        next_[static_cast<std::uint32_t>(words[i])] = words[i + 1];
    }
}

} // namespace argand
