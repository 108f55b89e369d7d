#pragma once

#include <array>
#include <cstddef>
#include <functional>

namespace argand {

/// Hash of several numbers, for containers. Equal numbers have equal hashes, 0 and -0 too.
struct HashFloats {
    template <std::size_t N> std::size_t operator()(const std::array<float, N>& numbers) const {
        std::size_t hash = 0;
        for (const float x : numbers) {
            hash = (hash ^ std::hash<float>()(x)) * 0x100000001b3;
        }
        return hash;
    }
};

} // namespace argand
