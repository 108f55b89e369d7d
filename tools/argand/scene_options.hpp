#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace argand {

/// The scene that a command reads, and the moment of its animations.
struct SceneOptions {
    std::string scene;
    std::optional<double> seconds; ///< none: nodes as they rest
    std::string choice;            ///< name or index of a scene of the file; empty: its default
};

/// Adds the scene's file, --at and --scene.
void add_scene_options(CLI::App& command, SceneOptions& options);

} // namespace argand
