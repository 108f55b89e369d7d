#pragma once

#include "session/render.hpp"

namespace argand {

/// The time in which light reaches the image, in seconds of the scene's animations.
struct Shutter {
    double open = 0, close = 0;
};

/// The moment that a pass of an image sees. The moments of the passes are a scrambled radical
/// inverse (Owen 1995): each is even over the shutter's time, so that an image of any number of
/// passes has no bias, and any 2^n passes from the first on have one in each 2^n-th part of it.
double moment_of(const Shutter& shutter, std::uint64_t pass, std::uint32_t seed);

/// The settings with as many passes as there are samples, each with its share of the photons.
RenderSettings with_pass_per_sample(RenderSettings settings);

/// Renders an image of what is seen while the shutter is open: each pass sees one moment. The
/// session must be of this scene and world, which are left at the last pass's moment. Throws Error
/// if a position is not finite, or the device cannot do it.
RenderResult render_through(Session& session, World& world, Scene& scene, const Shutter& shutter,
                            std::uint32_t seed, const OnProgress& on_progress);

} // namespace argand
