#pragma once

#include "shared/geometry_records.h"

#include <algorithm>

namespace argand {

/// The least box that contains both.
inline BoxRecord box_around(const BoxRecord& a, const BoxRecord& b) {
    return {std::min(a.low_x, b.low_x),   std::min(a.low_y, b.low_y),
            std::min(a.low_z, b.low_z),   0,
            std::max(a.high_x, b.high_x), std::max(a.high_y, b.high_y),
            std::max(a.high_z, b.high_z), 0};
}

} // namespace argand
