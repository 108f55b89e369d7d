#pragma once

#include <array>
#include <glm/glm.hpp>

namespace argand::truth {

/// Positional differentials at the end of a path of differential_case.hpp in double precision, and
/// the path's smallest cosine.
struct PathEnd {
    glm::dvec3 dp_du, dp_dv;
    double conditioning;
};
PathEnd path_end(int start, unsigned seed, unsigned walls);

} // namespace argand::truth
