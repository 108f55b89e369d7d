#pragma once

#include "methods/method.hpp"
#include "photon/photon_map.hpp"

#include <glm/glm.hpp>
#include <span>

namespace argand {

/// Decides up to which distance surfaces are nearby. Eye paths may follow their light instead of
/// taking it from the map, and do so if the settings give the distance, as in the decomposition of
/// Arikan, Forsyth and O'Brien (2005). Between the slats of a blind or the layers of a shell
/// photons are scattered often, and a disc mixes what they bring with the light on surfaces around.
/// usable: whether paths go on behind first estimates. points: in view; the fourth component does
/// not count.
void begin_near_field(RenderContext& context, std::span<const glm::vec4> points, bool usable);

/// Lets eye paths follow the light of nearby surfaces if that is a larger part of the photons that
/// were traced. Returns whether photons must be traced again: those of nearby surfaces are no
/// longer stored.
bool learn_near_field(RenderContext& context, const StoredPhotons& stored);

} // namespace argand
