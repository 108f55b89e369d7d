#pragma once

#include "scene/scene.hpp"

namespace argand {

/// A Cornell box with edges of length 2 that contains two boxes. All surfaces are Lambertian; a
/// square below the ceiling is the light.
Scene cornell_scene();

} // namespace argand
