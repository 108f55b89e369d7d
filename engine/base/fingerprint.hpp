#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace argand {

inline constexpr std::uint64_t empty_fingerprint = 0xcbf29ce484222325u;

/// 64-bit FNV-1a hash, which tells files apart unless a collision is crafted. `before` is the
/// fingerprint of the bytes that precede these.
inline std::uint64_t fingerprint(std::span<const std::byte> bytes,
                                 std::uint64_t before = empty_fingerprint) {
    std::uint64_t hash = before;
    for (const std::byte byte : bytes) {
        hash = (hash ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3u;
    }
    return hash;
}

} // namespace argand
