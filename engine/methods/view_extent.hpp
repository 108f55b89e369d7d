#pragma once

#include <glm/glm.hpp>
#include <span>

namespace argand {

/// Where the surfaces lie that are in view.
struct ViewExtent {
    glm::dvec3 middle{0}; ///< median along each axis
    double distance = 0;  ///< median distance from the middle
};

/// points: on these surfaces, at least one; the fourth component does not count.
ViewExtent view_extent(std::span<const glm::vec4> points);

} // namespace argand
