#pragma once

#include <algorithm>
#include <vector>

namespace argand {

/// The middle value, or the mean of the two in the middle. Requires at least one value.
inline double median(std::vector<double> values) {
    const std::size_t middle = values.size() / 2;
    std::sort(values.begin(), values.end());
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

} // namespace argand
