#pragma once

#include "accel/triangle_bvh.hpp"
#include "shared/geometry_records.h"

#include <span>
#include <vector>

namespace argand {

/// The closest hit of each ray. The rays lie in scratch memory. Waits for the device.
std::vector<HitRecord> closest_hits(Device& device, const TriangleBvh& bvh, Traversal traversal,
                                    std::span<const RayRecord> rays);

} // namespace argand
