#pragma once

#include "scene/gltf_source.hpp"
#include <filesystem>
#include <vector>

namespace argand {

/// Reads and parses a .gltf or .glb and the buffers that it names; images are left alone. What the
/// parser found odd, but read all the same, is added to `notes`. Error as load_gltf says.
GltfSource read_gltf_file(const std::filesystem::path& path, std::vector<std::string>& notes);

} // namespace argand
