#pragma once

#include "methods/render_result.hpp"
#include "methods/render_settings.hpp"
#include "scene/scene.hpp"

#include <map>
#include <string>
#include <vector>

namespace argand {

/// One point of a sweep: the base settings of a method, or those with one option changed.
struct Setting {
    std::string option;  ///< "default", or the option that differs from the base
    std::string value;   ///< of that option
    std::string key;     ///< parameter_key() of the settings
    std::string options; ///< command_options() of the settings
    RenderSettings render;
};

/// full: all options. quick: only numbers of photons and samples, and bandwidths.
enum class Extent { full, quick };

/// The bandwidths that methods chose for the base, by name. A sweep tries multiples of them.
using LearntBandwidths = std::map<std::string, RenderStatistics>;

/// The base settings of each of the named methods, and those with one option changed at a time, to
/// the values that the method table lists. Left out is what cannot change the picture: all options
/// in a scene without light, those of photons where no query finds any, those of caustics where no
/// lobe is followed, and values that equal the base's own.
std::vector<Setting> sweep(const Scene& scene, const RenderSettings& base,
                           const std::vector<std::string>& names, const LearntBandwidths& learnt,
                           Extent extent, MethodTable methods = builtin_methods());

} // namespace argand
