#pragma once

#include "methods/method.hpp"

#include <glm/glm.hpp>
#include <span>

namespace argand {

/// Distance from the camera within which nearly all lies that is in view; 0 if nothing is. queries:
/// points that are in view; the fourth component does not count.
double reach_of_view(std::span<const glm::vec4> queries, const Camera& camera);

/// Lets area samples lie within this distance of the camera only, if discs of this radius want more
/// on all surfaces than a map has room for: in a room on a large ground, they lie in the room and
/// before it. share: of the samples in a disc (area_samples of photon/radius.hpp). Does nothing if
/// they lie in a part only, or if reach is 0.
void sample_areas_in_view(RenderContext& context, double reach, double radius, double share);

} // namespace argand
