#pragma once

#include "scene/scene.hpp"

namespace argand {

/// Whether mip levels filter this texture of a material: only colours by which reflected light is
/// multiplied, so that its mean is right, and not where alpha decides what is present.
bool has_mips(const Scene& scene, const Material& material, const Texture& texture);

/// Whether they filter any of a material's textures.
bool has_mips(const Scene& scene, const Material& material);

} // namespace argand
