#pragma once

#include "photon/photon_map.hpp"

#include <vector>

namespace argand {

/// Makes the table of points in view, of which no cell is set. Places within `radius` of a point
/// are near it, and some farther ones.
ViewPoints make_view_points(Device& device, const std::vector<ViewPointRecord>& points,
                            double radius);

} // namespace argand
