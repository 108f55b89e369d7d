#pragma once

#include <cstdint>
#include <span>

namespace argand {

inline constexpr std::uint64_t empty_fingerprint = 0xcbf29ce484222325u;

/// FNV-1a of 64 bits, to tell files apart that are not meant to be alike; `before`: of what comes before these bytes.
inline std::uint64_t fingerprint(std::span<const std::uint8_t> bytes, std::uint64_t before = empty_fingerprint) {
    std::uint64_t hash = before;
    for (const std::uint8_t byte : bytes) {
        hash = (hash ^ byte) * 0x100000001b3u;
    }
    return hash;
}

} // namespace argand
