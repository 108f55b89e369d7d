#include "sweep/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {

std::vector<std::size_t> pareto_front(std::span<const TimeAndError> points) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (std::isfinite(points[i].seconds) && std::isfinite(points[i].error)) {
            order.push_back(i);
        }
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return points[a].seconds != points[b].seconds ? points[a].seconds < points[b].seconds
                                                      : points[a].error < points[b].error;
    });
    std::vector<std::size_t> front;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order) {
        if (points[i].error < least) {
            front.push_back(i);
            least = points[i].error;
        }
    }
    return front;
}

} // namespace argand
