#include "methods/queue_ages.hpp"

#include <cmath>

namespace argand {

void weigh_blocks(PhotonQueue& queue, const std::vector<BlockAge>& ages) {
    const auto weight = [&](std::uint32_t b) {
        return queue.blocks[b].moment > 0
                   ? static_cast<double>(ages[b].emitted) * std::exp2(-ages[b].half_lives)
                   : 0;
    };
    double sum = 0;
    for (std::uint32_t b = 0; b < queue.window; ++b) {
        sum += weight(b);
    }
    for (std::uint32_t b = 0; b < queue.window; ++b) {
        queue.blocks[b].weight = static_cast<float>(sum > 0 ? weight(b) / sum : 0);
    }
}

double effective_photons(const PhotonQueue& queue, const std::vector<BlockAge>& ages) {
    double noise = 0;
    for (std::uint32_t b = 0; b < queue.window; ++b) {
        const double weight = static_cast<double>(queue.blocks[b].weight);
        noise += weight > 0 ? weight * weight / static_cast<double>(ages[b].emitted) : 0;
    }
    return noise > 0 ? 1 / noise : 0;
}

} // namespace argand
