#pragma once

#include "base/fingerprint.hpp"
#include "scene/scene.hpp"

namespace argand {

/// Fingerprint of a scene's geometry and of the material of each triangle. `before`: the
/// fingerprint to continue from.
std::uint64_t fingerprint(const Scene& scene, std::uint64_t before = empty_fingerprint);

/// Fingerprint of all of a scene that a picture by one of its cameras shows.
std::uint64_t picture_fingerprint(const Scene& scene, std::size_t camera);

} // namespace argand
