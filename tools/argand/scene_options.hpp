#pragma once

#include "environment_options.hpp"
#include "scene/gltf.hpp"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace argand {

/// The scene that a command reads, its sky, its edits, and the moment of its animations.
struct SceneOptions : EnvironmentOptions {
    std::string scene;
    std::optional<double> seconds; ///< none: nodes as they rest
    LoadOptions load;
    std::string edits; ///< a file of edits (scene/edits.hpp); empty: none
};

/// Adds the scene's file, --at, --scene, --edits and the options of the sky and of what may be
/// read.
void add_scene_options(CLI::App& command, SceneOptions& options);

/// Loads the scene with its edits at a time of its animations; none: at rest. Throws UsageError
/// where the options contradict each other.
Scene load_scene(const SceneOptions& options, std::optional<double> seconds);

/// The index of the camera of that name or index; empty: the first. Throws Error if there is none.
std::size_t find_camera(const Scene& scene, const std::string& choice);

} // namespace argand
