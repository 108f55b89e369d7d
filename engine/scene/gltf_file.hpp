#pragma once

#include "scene/gltf_source.hpp"
#include <filesystem>
#include <vector>

namespace argand {

/// Reads and parses a .gltf or .glb and the buffers that it names; images are not read. Adds the
/// parser's warnings to `notes`. Throws Error like load_gltf.
GltfSource read_gltf_file(const std::filesystem::path& path, const LoadOptions& options,
                          std::vector<std::string>& notes);

} // namespace argand
