#pragma once

#include "methods/eye_tracing.hpp"
#include "methods/method.hpp"

#include <vector>

namespace argand {

/// Whether light may reach what is in view only by mirrors or glass, so that the shadow rays of
/// eye paths do not find the lights that it comes from.
bool may_hide_lights(const DeviceScene& scene);

/// The lights of a few photons that are stored in view, as indirect light: `point` and `direction`
/// are those of the photon's first ray, and `pixel` is a cell of the picture. Requires a photon
/// map. Waits for the device.
std::vector<FoundLight> find_lights_of_photons(RenderContext& context);

} // namespace argand
