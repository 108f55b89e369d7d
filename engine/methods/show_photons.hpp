#pragma once

#include "methods/method.hpp"
#include "photon/photon_map.hpp"

namespace argand {

/// Makes the picture one of the photons of a map (Shi 2012, figures 4.6 to 4.9): a pixel in which
/// photons lie that the camera sees has the largest of their colours, each of them scaled to a
/// largest channel of 1; all others are black. Waits for the device.
void draw_photons(RenderContext& context, const PhotonMap& map);

} // namespace argand
