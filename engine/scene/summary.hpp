#pragma once

#include "scene/scene.hpp"
#include <nlohmann/json.hpp>
#include <string>

namespace argand {

/// What a material is, in a few words: "Lambertian", "mirror", "glass", ...
std::string describe(const Material& material);

/// What is in a scene: counts, bounds, area, materials, lights with the power they emit, cameras,
/// animations, extensions and which of them are not understood, notes.
nlohmann::ordered_json summary_json(const Scene& scene);

/// The same for people to read; several lines, the last one ended.
std::string summary_text(const Scene& scene);

} // namespace argand
