#pragma once

#include "scene/gltf_accessor.hpp"
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace argand {

/// The opened accessors of a primitive.
struct Surface {
    GltfAccessor positions;
    GltfAccessor normals;
    GltfAccessor indices;
    std::vector<std::pair<std::uint32_t, GltfAccessor>> uvs; ///< sets that the material needs
    GltfAccessor tangents; ///< if the material has a normal texture
    GltfAccessor colors;
    bool has_tangents = false;
    bool has_colors = false;
    bool has_normals = false;
    bool has_indices = false;
    int mode = TINYGLTF_MODE_TRIANGLES;
    std::size_t corner_count = 0; ///< indices, or vertices if there are no indices
};

/// Number of triangles that so many corners make.
std::size_t triangle_count(int mode, std::size_t corners);

/// Corners of triangle `i` as positions in the index list: glTF 2.0, section 3.7.2.1.
glm::uvec3 triangle_corners(int mode, std::uint32_t i);

/// The accessor of an attribute, or -1.
int attribute(const tinygltf::Primitive& primitive, const char* name);

/// Whether an accessor holds three-component vectors of a type that glTF allows for vertices.
bool is_attribute_type(const GltfAccessor& accessor);

/// Opens what the primitive has for the textures of a material, and its colours.
void open_texture_attributes(const GltfSource& source, const tinygltf::Primitive& primitive,
                             const std::string& name, std::uint32_t material, Surface& surface,
                             Scene& scene);

/// Opens the primitive's accessors, but for those of textures. Returns false if it has no surface
/// (points, lines, no positions, no corners).
bool open_surface(const GltfSource& source, const tinygltf::Primitive& primitive,
                  const std::string& name, Surface& surface, Scene& scene);

} // namespace argand
