#pragma once

#include "scene/scene.hpp"

namespace argand {

/// A perspective camera (45° vertically) that sees the whole box from the front (glTF's +Z),
/// slightly from the right and from above. Everything fits into square and wider images.
Camera frame_bounds(const Bounds& box);

} // namespace argand
