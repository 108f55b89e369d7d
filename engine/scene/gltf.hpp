#pragma once

#include "scene/scene.hpp"
#include <filesystem>
#include <optional>
#include <string>

namespace argand {

/// What a file may make the loader do.
struct LoadOptions {
    bool allow_external = false;   ///< read buffers and images outside the file's folder
    bool grey_for_missing = false; ///< where an image's file does not exist
    std::string scene;             ///< name or index of the file's scene; empty: its default
    bool movable_nodes = false;    ///< keep what edits need to move nodes (scene/edits.hpp)
};

/// Loads a glTF 2.0 file (.gltf or .glb, told apart by content) and the buffers that it names.
/// Loads the scene of the name or index `options.scene`; if that is empty the default one, else the
/// first, else all root nodes. Positions, normals, lights and
/// cameras are converted to world space, at a moment of the file's animations, or as the nodes
/// rest. seconds: finite; before the first key and after the last one a property keeps that key's
/// value. Scene::notes lists unsupported features and objects that were added (a camera, a studio).
/// Throws Error if the file cannot be read, is invalid where it matters, requires an unsupported
/// extension, or contains nothing to render.
Scene load_gltf(const std::filesystem::path& path, std::optional<double> seconds = {},
                const LoadOptions& options = {});

} // namespace argand
