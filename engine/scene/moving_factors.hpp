#pragma once

#include "scene/scene.hpp"

namespace argand {

/// The factors of a light at a time in seconds. Those without keys stay as they are at rest.
LightFactors factors_at(const LightKeys& keys, const LightFactors& rest, double seconds);

/// The factors of a material at a time in seconds. Those without keys stay as they are at rest.
MaterialFactors factors_at(const MovingMaterial& material, double seconds);

/// Gives a camera the angle or extent of a time in seconds, clamped to its range.
void set_view(const CameraKeys& keys, double seconds, Camera& camera);

/// What moves of material `index` of the scene; null: nothing.
const MovingMaterial* moving_material(const Motion& motion, std::size_t index);

/// The times of all keys of a material's properties, rising.
std::vector<double> key_times(const MaterialKeys& keys);

/// Whether the material is visible at rest, or its alpha moves.
bool may_be_visible(const Scene& scene, std::size_t material);

/// Whether the material emits light at rest, or what moves may make it emit.
bool may_emit(const Scene& scene, std::size_t material);

} // namespace argand
