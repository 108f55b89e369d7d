#pragma once

#include "photon/estimator.hpp"

#include <vector>

namespace argand {

inline constexpr float bench_reflectance = 0.2f;

/// A query of a Lambertian surface.
QueryRecord bench_query(const glm::vec3& place, const glm::vec3& normal);

/// The queries on the device.
PhotonQueries bench_queries(Device& device, const std::vector<QueryRecord>& records);

} // namespace argand
