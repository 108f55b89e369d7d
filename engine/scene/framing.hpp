#pragma once

#include "scene/scene.hpp"

namespace argand {

/// A perspective camera (45° vertically) that sees the whole box from the front (glTF's +Z), a
/// little from the right and from above; everything fits into a square picture and into wider ones.
Camera frame_bounds(const Bounds& box);

} // namespace argand
