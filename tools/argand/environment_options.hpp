#pragma once

#include "scene/gltf.hpp"
#include "scene/scene.hpp"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace argand {

/// The sky that replaces the scene's.
struct EnvironmentOptions {
    std::string env; ///< a file, or "R,G,B"; empty: none
    std::string sun; ///< "ELEVATION,AZIMUTH" or "ELEVATION,AZIMUTH,TURBIDITY"; empty: none
    std::optional<double> rotation;
    std::optional<double> strength;
};

/// Adds --env, --sun, --env-rotation and --env-strength.
void add_environment_options(CLI::App& command, EnvironmentOptions& options);

/// Loads a scene, with the sky that the options describe, if any. Throws UsageError where they
/// contradict each other.
Scene load_scene(const std::string& file, const EnvironmentOptions& options,
                 std::optional<double> seconds = {}, const LoadOptions& load = {});

} // namespace argand
