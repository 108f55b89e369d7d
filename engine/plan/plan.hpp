#pragma once

#include "plan/surface_use.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace argand {

/// A part of the renderer (code, buffers, passes) that some scenes do not need.
enum class Feature : std::uint8_t {
    // Surfaces.
    diffuse,
    ggx,   ///< glossy reflection by GGX
    phong, ///< glossy reflection by modified Phong
    mirror,
    transmission,
    refraction,    ///< at the interface of a solid
    rough_glass,   ///< transmission and refraction by rough surfaces
    absorption,    ///< inside a solid
    nested_solids, ///< solids that may overlap
    coat,          ///< of varnish
    rough_coat,
    coat_normal, ///< coats with normals of their own
    sheen,
    anisotropy,     ///< of glossy reflection
    iridescence,    ///< thin films
    dispersion,     ///< of colours by a solid
    unlit,          ///< surfaces that show their base colour
    alpha,          ///< some surface lets light pass
    smooth_normals, ///< interpolated from the vertices' normals
    textures,
    vertex_colors,
    emissive_textures, ///< emissive triangles shine by their texels
    mip_maps,          ///< of textures, chosen by paths' cones
    normal_textures,
    other_textures, ///< of specular reflection, transmission and thickness
    // Lights.
    point_light,
    spot_light,
    directional_light,
    emissive_triangles,
    sky,
    sky_picture,    ///< a sky that is not uniform
    several_lights, ///< requires choosing a light
    // Paths. A path continues through followed lobes (smooth ones, and glossy ones up to
    // follow_roughness); light arriving at estimated lobes is estimated (docs/path-classes.md).
    followed_paths,
    glossy_estimates, ///< some estimated lobe is not Lambertian
    direct_light,     ///< shadow rays
    // Request.
    photon_map,
    light_paths,   ///< photons whose hits are connected with the eye
    differentials, ///< photon differentials
    caustics,      ///< photons that only followed lobes have scattered
    cube_maps,     ///< of the surfaces, in which photons find their hits
    final_gather
};

/// The parts of a request on which features depend.
struct PlanRequest {
    float follow_roughness = 0.25f; ///< glossy lobes of at most this roughness are followed
    bool cull_back_faces = false;   ///< eye paths go through those of one-sided surfaces
    bool photon_map = true;
    bool light_paths = false; ///< photons' hits are connected with the eye
    bool footprints = true;   ///< photons have footprints
    bool cube_maps = false;   ///< photons find their hits in cube maps
    bool final_gather = false;
    /// Count what materials require at rest and at their keys, instead of now, so that it is the
    /// same at all times.
    bool at_any_time = false;
    /// Require all features regardless of the scene, to measure and test the effect of leaving
    /// features out.
    bool everything = false;
};

/// The features that a scene and a request require, each with the first object that requires it:
/// "material 'gold'".
struct Plan {
    PlanRequest request;
    std::map<Feature, std::string> required;

    bool needs(Feature feature) const { return required.contains(feature); }
    /// Whether lights emit photons.
    bool needs_photons() const { return needs(Feature::photon_map) || needs(Feature::light_paths); }
    /// LOBE_* and MATERIAL_* bits of shared/bsdf.h.
    std::uint32_t material_features() const;
    /// Bits of the light kinds: 1 << light_* of shared/light_record.h.
    std::uint32_t light_kinds() const;
};

/// The features required by the scene's triangles, their materials, and its lights; unused
/// materials do not count. Leaving out all other features changes no bit of any result.
Plan make_plan(const Scene& scene, const PlanRequest& request);
/// The same, for a scene whose triangles use its materials like this.
Plan make_plan(const Scene& scene, const SurfaceUse& use, const PlanRequest& request);

/// Texts about a feature, for the user.
struct FeatureText {
    const char* key;  ///< "smooth_normals"
    const char* name; ///< "interpolated normals"
    std::string cost; ///< memory and passes that it costs, if it is more than code
};
FeatureText text_of(Feature feature);

/// All features, in their order.
std::vector<Feature> all_features();

} // namespace argand
