#pragma once

#include "base/archive.hpp"
#include "methods/method.hpp"
#include "world/area_table.hpp"

#include <glm/glm.hpp>
#include <span>

namespace argand {

/// The parts of a scene in which nearly all lies that is in view. Their reach is 0 if nothing is.
struct ViewParts {
    SampledPart around_eye{.reach = 0};
    SampledPart around_points{.reach = 0}; ///< smaller in a close-up, and without its surroundings
};

/// queries: points that are in view; the fourth component does not count.
ViewParts parts_of_view(std::span<const glm::vec4> queries, const Camera& camera);

void persist_view(Archive& archive, ViewParts& view);

/// Lets area samples lie around the camera only, if discs of this radius want more on all surfaces
/// than a map has room for: in a room on a large ground, they lie in the room and before it. If
/// these are still so many that none would be taken (area_samples), they lie around the points in
/// view. share: of the samples in a disc (area_samples of photon/radius.hpp). Does nothing if they
/// lie there already, or if nothing is in view.
void sample_areas_in_view(RenderContext& context, const ViewParts& view, double radius,
                          double share);

} // namespace argand
