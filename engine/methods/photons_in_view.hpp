#pragma once

#include "scene/camera.hpp"
#include "shared/photon_records.h"

#include <glm/glm.hpp>
#include <span>

namespace argand {

/// The share of these photons, of which some records may be empty, that lie on surfaces that the
/// picture shows directly, not by way of mirrors or glass; 0 without photons. queries: points in
/// view, whose fourth component does not count. A photon is in view if it lies within the picture,
/// on the side of its surface that faces the camera, and no deeper than the points around it.
/// aspect: width / height of the picture.
double share_in_view(std::span<const PhotonRecord> photons, std::span<const glm::vec4> queries,
                     const Camera& camera, double aspect);

} // namespace argand
