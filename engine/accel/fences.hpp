#pragma once

#include "device/device.hpp"

#include <string>

namespace argand {

/// The value of `fences` in memory_fence.glsl.
inline bool needs_fences(const Device& device) {
    return device.info().driver.find("llvmpipe") == std::string::npos;
}

} // namespace argand
