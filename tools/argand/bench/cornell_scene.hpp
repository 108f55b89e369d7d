#pragma once

#include "scene/scene.hpp"

namespace argand {

/// A Cornell box of edge 2 with two boxes, all Lambertian, lit by a square under its ceiling.
Scene cornell_scene();

} // namespace argand
