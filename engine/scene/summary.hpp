#pragma once

#include "scene/scene.hpp"
#include <nlohmann/json.hpp>
#include <string>

namespace argand {

/// The kind of a material in a few words: "Lambertian", "mirror", "glass", ...
std::string describe(const Material& material);

/// Contents of a scene: counts, bounds, area, materials, lights with their power, cameras,
/// animations, extensions (and whether each is supported), notes.
nlohmann::ordered_json summary_json(const Scene& scene);

/// The same as text for the user; several lines, the last one ended.
std::string summary_text(const Scene& scene);

} // namespace argand
