#pragma once

#include "methods/render_settings.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace argand {

/// What the scene and the settings require. Throws UsageError on an unknown method.
Plan plan_render(const Scene& scene, const RenderSettings& settings,
                 MethodTable methods = builtin_methods());
/// The same, for a scene whose triangles use its materials like this.
Plan plan_render(const Scene& scene, const SurfaceUse& use, const RenderSettings& settings,
                 MethodTable methods);

/// The method for a scene if the user names none: the table's first, `footprints`, where there may
/// be caustics at any time, else the one that autotuning tries first, `photons`
/// (docs/photon-map.md).
const MethodInfo& method_for(const Scene& scene, const RenderSettings& settings,
                             MethodTable methods = builtin_methods());

/// The method without bias whose pictures of a scene count as true: one with light paths where
/// there may be caustics, which eye paths find rarely or not at all, else the table's first. Null
/// if no method is unbiased.
const MethodInfo* reference_method(const Scene& scene, const RenderSettings& settings,
                                   MethodTable methods = builtin_methods());

/// Whether methods without bias miss light that photons find: the caustics of delta lights by way
/// of mirrors or glass. Paths from the eye miss all of these, light paths those that are seen in a
/// mirror or through glass.
bool is_blind_to_caustics(const Scene& scene);

} // namespace argand
