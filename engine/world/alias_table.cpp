#include "world/device_scene.hpp"

#include <algorithm>
#include <numeric>

namespace argand {

std::vector<LightChoice> alias_table(const std::vector<double>& weights) {
    const std::size_t n = weights.size();
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<LightChoice> table(n);
    std::vector<double> scaled(n);
    std::vector<std::uint32_t> small;
    std::vector<std::uint32_t> large;
    for (std::size_t i = 0; i < n; ++i) {
        const double probability = sum > 0 ? weights[i] / sum : 1.0 / static_cast<double>(n);
        table[i] = {1, static_cast<std::uint32_t>(i), static_cast<float>(probability), 0};
        scaled[i] = probability * static_cast<double>(n);
        (scaled[i] < 1 ? small : large).push_back(static_cast<std::uint32_t>(i));
    }
    while (!small.empty() && !large.empty()) {
        const std::uint32_t poor = small.back();
        const std::uint32_t rich = large.back();
        small.pop_back();
        table[poor].keep = static_cast<float>(scaled[poor]);
        table[poor].alias = rich;
        scaled[rich] -= 1 - scaled[poor];
        if (scaled[rich] < 1) {
            large.pop_back();
            small.push_back(rich);
        }
    }
    // Rows left over have a scaled probability of 1 but for rounding, and keep their choice. A row
    // of weight 0 must never be chosen: it passes every choice on.
    for (const std::uint32_t i : small) {
        if (sum > 0 && !(weights[i] > 0)) {
            table[i].keep = 0;
            table[i].alias = static_cast<std::uint32_t>(
                std::max_element(weights.begin(), weights.end()) - weights.begin());
        }
    }
    return table;
}

} // namespace argand
