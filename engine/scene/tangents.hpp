#pragma once

#include "scene/scene.hpp"

namespace argand {

/// Fills Scene::tangents if any surface has a normal texture: those of the file, and where it has
/// none the directions in which the texture's u grows, as MikkTSpace averages them (Mikkelsen
/// 2008): over triangles that share position, normal, texture coordinates and handedness of a
/// corner, weighted by their angles there. Corners without a normal keep their triangle's.
void add_tangents(Scene& scene);

} // namespace argand
