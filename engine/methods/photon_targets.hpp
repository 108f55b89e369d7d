#pragma once

#include "methods/method.hpp"

#include <glm/glm.hpp>
#include <span>

namespace argand {

/// Aims some of the photons from lights inside the scene at small casters of caustics near what is
/// in view, which few photons would hit otherwise (the projection maps of Jensen 1996 have the same
/// purpose). points: in view.
void aim_at_casters(RenderContext& context, std::span<const glm::vec4> points);

/// Aims some of the photons that lights inside the scene emit, and of those that rough surfaces
/// scatter, from elsewhere at what is in view, if that is a small part of the scene. points: in
/// view, also by mirrors and through glass.
void aim_at_view(RenderContext& context, std::span<const glm::vec4> points);

} // namespace argand
