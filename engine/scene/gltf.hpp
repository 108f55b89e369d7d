#pragma once

#include "scene/scene.hpp"
#include <filesystem>

namespace argand {

/// Reads a glTF 2.0 file (.gltf or .glb, told apart by content) and the buffers that it names: the
/// default scene, else the first, else all root nodes. Positions, normals, lights and cameras come
/// out in world space. What is in the file and not understood, and what had to be made up (a
/// camera, a sky), is said in Scene::notes. Error if the file cannot be read, is not valid where
/// that matters, requires an extension that is not understood, or holds nothing to render.
Scene load_gltf(const std::filesystem::path& path);

} // namespace argand
