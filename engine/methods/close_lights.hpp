#pragma once

#include "methods/method.hpp"

namespace argand {

/// Looks from each lamp at the surfaces around it, and lets some of the eye paths be aimed at those
/// that are close (shared/close_light.h): paths that hit them by chance are rare and very bright.
/// Does nothing where no point or spot light has surfaces close to it. Waits for the device.
void aim_at_close_lights(RenderContext& context);

} // namespace argand
