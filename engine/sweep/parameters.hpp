#pragma once

#include "methods/render.hpp"

#include <string>
#include <utility>
#include <vector>

namespace argand {

/// An option of `argand render` and its value; flags are "on" or "off".
using Parameter = std::pair<std::string, std::string>;

/// All that decides the picture of a method but its seed, its size and its camera; "auto" is what
/// the scene decides.
std::vector<Parameter> parameters(const RenderSettings& settings);

/// The same as one text, by which a setting is known.
std::string parameter_key(const RenderSettings& settings);

/// The options of `argand render` that ask for these settings: what is not the default.
std::string command_options(const RenderSettings& settings);

} // namespace argand
