#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace argand {

/// The cost of a setting in seconds, and its error.
struct TimeAndError {
    double seconds = 0;
    double error = 0;
};

/// Indices of the non-dominated points, fastest first. Omits points that are not finite; of equal
/// points it keeps the first.
std::vector<std::size_t> pareto_front(std::span<const TimeAndError> points);

} // namespace argand
