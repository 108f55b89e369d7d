#pragma once

#include "scene/gltf_source.hpp"
#include <string_view>

namespace argand {

/// Whether the loader supports the extension, at least in part (a note then says what it ignores).
bool supports_extension(std::string_view name);

/// Adds the file's list of used extensions to the scene, with a note for each that is not
/// supported. Throws Error if the file requires one that is not supported.
void add_extensions(const GltfSource& source, Scene& scene);

} // namespace argand
