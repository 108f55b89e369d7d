#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace argand {

/// What a setting costs and what it leaves.
struct TimeAndError {
    double seconds = 0;
    double error = 0;
};

/// Indices of the points to which no other is as quick and as exact and better in one of them, the
/// quickest first. Points that are not finite are left out; of equal ones the first stays.
std::vector<std::size_t> pareto_front(std::span<const TimeAndError> points);

} // namespace argand
