#pragma once

#include "methods/method.hpp"

namespace argand {

/// Learns from a few paths which lights reach what is in view, directly and by reflection, and
/// lets shadow rays and photons prefer those lights (`learnt_shares`). Aims most of the photons
/// that come from outside at the places where such light arrives, if those lie close together.
/// Does nothing where there is no choice: with one emitter inside the scene.
void learn_lights(RenderContext& context);

/// Takes over what was learnt about the lights of the scene at another moment.
void keep_learnt(RenderContext& context, const DeviceScene& before);

/// Saves or loads what was learnt about the lights, by learn_lights() and by the method: how they
/// are chosen, where photons are aimed, and where areas are sampled.
void persist_lights(Archive& archive, RenderContext& context);

} // namespace argand
