#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace argand {

inline constexpr const char* nanoflann_name = "nanoflann";

/// Queries per second for the k nearest points, one query at a time on all of the machine's
/// threads: median of several runs, without building the tree; 0 if the build did not find
/// nanoflann.
double nanoflann_rate(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& queries,
                      std::uint32_t k);

} // namespace argand
