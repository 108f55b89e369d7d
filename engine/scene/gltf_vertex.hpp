#pragma once

#include "scene/gltf_surface.hpp"

namespace argand {

/// Adds texture coordinates and colour of a vertex to a scene that has as many of them as vertices,
/// none of which is this one. vertex: index in the accessors. Throws Error if a coordinate is not
/// finite.
void add_texture_attributes(const GltfSource& source, const Surface& surface, std::size_t vertex,
                            std::uint32_t material, const std::string& name, Scene& scene);

} // namespace argand
