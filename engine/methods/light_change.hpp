#pragma once

#include "world/light_table.hpp"

namespace argand {

/// How much light changes from one moment to another, in relation to itself, as the change of the
/// light that changes most: the distance by which it moves over `distance`, the angle in radians by
/// which it turns, and the share by which its colour or power changes. Infinity if a light appears
/// or vanishes. distance: a typical one between lights and surfaces.
double light_change(const LightTable& before, const LightTable& now, double distance);

/// How much faster than 2^-1 per half-life photons of an earlier moment have to lose weight: the
/// half-life, in frames, that balances the lag of their light, which changes by this much in a
/// frame, against the noise of those that are left. window: frames in which all photons are
/// replaced. in_disc: photons that an estimate finds. Infinity if nothing changes.
double balanced_half_life(double change, double window, double in_disc);

} // namespace argand
