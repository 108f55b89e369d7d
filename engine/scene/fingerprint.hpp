#pragma once

#include "base/fingerprint.hpp"
#include "scene/scene.hpp"

namespace argand {

/// Fingerprint of a scene's geometry and of the material of each triangle. `before`: the
/// fingerprint to continue from.
std::uint64_t fingerprint(const Scene& scene, std::uint64_t before = empty_fingerprint);

} // namespace argand
