#pragma once

#include "methods/render_settings.hpp"

#include <string>
#include <utility>
#include <vector>

namespace argand {

/// An option of `argand render` and its value; flags are "on" or "off", "auto" is a value that the
/// method chooses.
using Parameter = std::pair<std::string, std::string>;

/// The method and all its options: what decides the picture besides its seed, size and camera.
std::vector<Parameter> parameters(const RenderSettings& settings,
                                  MethodTable methods = builtin_methods());

/// The parameters as one text, which identifies the settings.
std::string parameter_key(const RenderSettings& settings, MethodTable methods = builtin_methods());

/// The options of `argand render` that ask for these settings, without those at their defaults.
std::string command_options(const RenderSettings& settings,
                            MethodTable methods = builtin_methods());

} // namespace argand
