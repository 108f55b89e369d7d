#pragma once

#include "base/archive.hpp"
#include "base/error.hpp"
#include "device/device.hpp"

namespace argand {

/// Saves or loads the first bytes of a buffer. Waits for the device.
inline void persist_buffer(Archive& archive, Device& device, const Buffer& buffer,
                           std::uint64_t bytes) {
    std::vector<std::byte> contents;
    if (!archive.loads()) {
        contents = download<std::byte>(device, buffer, bytes);
    }
    archive.values(contents);
    if (contents.size() != bytes) {
        fail("loading a saved state: '{}' has another size", buffer.name());
    }
    if (archive.loads()) {
        device.upload(buffer, 0, contents);
    }
}

} // namespace argand
