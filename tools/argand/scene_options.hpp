#pragma once

#include "environment_options.hpp"
#include "scene/gltf.hpp"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace argand {

/// The scene that a command reads, its sky, and the moment of its animations.
struct SceneOptions : EnvironmentOptions {
    std::string scene;
    std::optional<double> seconds; ///< none: nodes as they rest
    LoadOptions load;
};

/// Adds the scene's file, --at, --scene and the options of the sky and of what may be read.
void add_scene_options(CLI::App& command, SceneOptions& options);

} // namespace argand
