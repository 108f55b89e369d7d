#pragma once

#include "scene/camera.hpp"
#include "shared/photon_records.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace argand {

/// The cell of a photon that is not in view.
inline constexpr std::uint32_t out_of_view = 0xffffffffu;

/// For each of these photons, of which some records may be empty, in which cell of the picture it
/// is if it lies on surfaces that the picture shows directly, not by way of mirrors or glass, else
/// out_of_view. queries: points in view, whose fourth component does not count. A photon is in view
/// if it lies within the picture, on the side of its surface that faces the camera, and no deeper
/// than the points around it. aspect: width / height of the picture.
std::vector<std::uint32_t> cells_in_view(std::span<const PhotonRecord> photons,
                                         std::span<const glm::vec4> queries, const Camera& camera,
                                         double aspect);

/// The share of the photons that are in view, as above; 0 without photons.
double share_in_view(std::span<const PhotonRecord> photons, std::span<const glm::vec4> queries,
                     const Camera& camera, double aspect);

} // namespace argand
