#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace argand {

/// The value that a share of the others, in [0, 1], does not exceed. Requires at least one value.
inline double quantile(std::vector<double> values, double share) {
    const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
    const auto at_rank = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), at_rank, values.end());
    return *at_rank;
}

} // namespace argand
