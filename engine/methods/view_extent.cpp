#include "methods/view_extent.hpp"

#include "base/median.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace argand {

ViewExtent view_extent(std::span<const glm::vec4> points) {
    ViewExtent view;
    std::vector<double> numbers(points.size());
    for (int axis = 0; axis < 3; ++axis) {
        std::transform(points.begin(), points.end(), numbers.begin(),
                       [&](const glm::vec4& point) { return point[axis]; });
        view.middle[axis] = median(numbers);
    }
    std::transform(points.begin(), points.end(), numbers.begin(), [&](const glm::vec4& point) {
        return glm::distance(glm::dvec3(point), view.middle);
    });
    view.distance = median(std::move(numbers));
    return view;
}

} // namespace argand
