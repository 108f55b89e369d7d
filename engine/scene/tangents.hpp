#pragma once

#include "scene/scene.hpp"

namespace argand {

/// Whether surfaces of a material need tangents: it or its coat has a normal texture, or it is
/// anisotropic.
bool needs_tangents(const Scene& scene, std::uint32_t material);

/// The texture whose coordinates give a material's surfaces their tangents: that of its normals,
/// else that of its coat's normals, else that of its anisotropy. Null if it has none: then the
/// first set of coordinates gives them.
const Texture* tangent_texture(const Scene& scene, std::uint32_t material);

/// Fills Scene::tangents if any surface needs them: those of the file,
/// and where it has none the directions in which u of tangent_texture() grows, as MikkTSpace
/// averages them (Mikkelsen 2008): over triangles that share position, normal, texture coordinates
/// and handedness of a corner, weighted by their angles there. Corners without a normal keep their
/// triangle's.
void add_tangents(Scene& scene);

} // namespace argand
