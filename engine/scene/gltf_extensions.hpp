#pragma once

#include "scene/gltf_source.hpp"
#include <string_view>

namespace argand {

/// True if the loader does what the extension says, at least in part (a note then says what it
/// leaves out).
bool understands_extension(std::string_view name);

/// Takes over which extensions the file uses. Those not understood are named in a note each; Error
/// if the file requires one of them.
void add_extensions(const GltfSource& source, Scene& scene);

} // namespace argand
