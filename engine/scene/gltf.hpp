#pragma once

#include "scene/scene.hpp"
#include <filesystem>

namespace argand {

/// Loads a glTF 2.0 file (.gltf or .glb, told apart by content) and the buffers that it names.
/// Loads the default scene, else the first, else all root nodes. Positions, normals, lights and
/// cameras are converted to world space. Scene::notes lists unsupported features and objects that
/// were added (a camera, a sky). Throws Error if the file cannot be read, is invalid where it
/// matters, requires an unsupported extension, or contains nothing to render.
Scene load_gltf(const std::filesystem::path& path);

} // namespace argand
