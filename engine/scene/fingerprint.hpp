#pragma once

#include "base/fingerprint.hpp"
#include "scene/scene.hpp"

namespace argand {

/// Of a scene's geometry and of which material each triangle has; `before`: of what comes before
/// it.
std::uint64_t fingerprint(const Scene& scene, std::uint64_t before = empty_fingerprint);

} // namespace argand
