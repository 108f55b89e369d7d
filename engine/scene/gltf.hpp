#pragma once

#include "scene/scene.hpp"
#include <filesystem>
#include <optional>
#include <string>

namespace argand {

/// Loads a glTF 2.0 file (.gltf or .glb, told apart by content) and the buffers that it names.
/// Loads the scene of the name or index `choice`; if that is empty the default scene, else the
/// first, else all root nodes. Positions, normals, lights and
/// cameras are converted to world space, at a moment of the file's animations, or as the nodes
/// rest. seconds: finite; before the first key and after the last one a property keeps that key's
/// value. Scene::notes lists unsupported features and objects that were added (a camera, a sky).
/// Throws Error if the file cannot be read, is invalid where it matters, requires an unsupported
/// extension, or contains nothing to render.
Scene load_gltf(const std::filesystem::path& path, std::optional<double> seconds = {},
                const std::string& choice = "");

} // namespace argand
