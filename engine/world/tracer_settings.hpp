#pragma once

#include <cstdint>

namespace argand {

/// Through which tree rays go. They hit the same, to the bit.
struct TracerSettings {
    bool kdtree = false;                  ///< else a four-wide tree of bounding boxes
    std::uint64_t tree_memory = 1u << 30; ///< bytes of a kd-tree, at most
};

} // namespace argand
