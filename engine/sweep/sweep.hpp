#pragma once

#include "methods/render.hpp"
#include "scene/scene.hpp"

#include <map>
#include <string>
#include <vector>

namespace argand {

/// One point of a sweep: the base, or the base with one knob turned.
struct Setting {
    std::string knob;  ///< "default", or the option that differs from it
    std::string value; ///< that option's
    RenderSettings render;
};

/// How wide a sweep is.
enum class Extent { full, quick };

/// What methods chose by themselves for the base, by name: automatic widths are turned relative to
/// these.
using LearntWidths = std::map<std::string, RenderStatistics>;

/// Which of the base's lobes, lights and photons a scene has any use for.
struct SceneUse {
    bool lit = false;       ///< something emits
    bool estimated = false; ///< some lobe is estimated: photon maps are asked
    bool followed = false;  ///< some lobe is followed: there may be caustics
    bool glossy = false;    ///< some lobe is neither smooth nor Lambertian
};
SceneUse use_of(const Scene& scene, const RenderSettings& base);

/// Every method, once, with its numbers of photons and samples, and each other knob of it one at a
/// time around `base`. What cannot change anything is left out: knobs that the method does not
/// have, those of photons where nothing asks for them, of caustics where no lobe is followed, and
/// values that are the base's own.
std::vector<Setting> sweep(const Scene& scene, const RenderSettings& base,
                           const std::vector<std::string>& methods, const LearntWidths& learnt,
                           Extent extent);

} // namespace argand
