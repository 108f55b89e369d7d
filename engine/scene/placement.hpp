#pragma once

#include "scene/scene.hpp"

namespace argand {

/// How a transform to world space moves vertices.
struct VertexTransform {
    glm::dmat4 point;
    glm::dmat3 normal; ///< up to a positive factor
    bool mirrors;      ///< flips the orientation of triangles
};

VertexTransform vertex_transform(const glm::dmat4& to_world);

/// Whether a position can be stored; false for NaN.
bool fits_float(const glm::dvec3& position);

/// Places a light as its node does; glTF's lights shine along −Z. Returns false if the transform
/// leaves it no direction, which stays as it was.
bool place(const glm::dmat4& to_world, Light& light);

/// Places a camera as its node does; glTF's cameras look along −Z with +Y up. Returns false if the
/// transform leaves it no direction, which stays as it was.
bool place(const glm::dmat4& to_world, Camera& camera);

} // namespace argand
