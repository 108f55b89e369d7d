#pragma once

#include "scene/gltf.hpp"
#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace argand {

/// The scene that a command reads, and the moment of its animations.
struct SceneOptions {
    std::string scene;
    std::optional<double> seconds; ///< none: nodes as they rest
    LoadOptions load;
};

/// Adds the scene's file and --at.
void add_scene_options(CLI::App& command, SceneOptions& options);

} // namespace argand
