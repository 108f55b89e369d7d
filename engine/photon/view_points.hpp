#pragma once

#include "photon/photon_map.hpp"

#include <vector>

namespace argand {

/// Makes the table of points in view; their cells need not be set. A place is near a point if that
/// is in the two rings of cells around its own, which reach at least one `radius`.
ViewPoints make_view_points(Device& device, const std::vector<ViewPointRecord>& points,
                            double radius);

} // namespace argand
