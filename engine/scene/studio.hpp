#pragma once

#include "scene/scene.hpp"

namespace argand {

/// The light of a scene that has none: neutral grey, 1 cd/m² from above, half of it from the
/// horizon and a tenth from below, so that white surfaces stand out from it and show their shape.
Environment studio();

/// Gives a scene without light the studio, and a note that says so.
void add_studio(Scene& scene);

/// Gives the scene another sky, in the place of its own and of the studio with its note.
void replace_sky(Scene& scene, const glm::vec3& radiance);
void replace_sky(Scene& scene, Environment environment);

} // namespace argand
