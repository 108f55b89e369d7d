#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace argand {

/// Error unless `bytes` are an OpenEXR file that tinyexr decodes soundly: tinyexr 1.0.1 asserts on
/// some attributes, misreads sub-sampled channels, and leaves rows that no chunk covers
/// uninitialised. `name` is the file's, for the message. Layout: "OpenEXR File Layout",
/// openexr.com.
void check_exr(std::span<const std::uint8_t> bytes, std::string_view name);

} // namespace argand
