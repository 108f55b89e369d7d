#pragma once

#include "scene/scene.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace argand {

/// What a renderer has and a scene may do without: code, buffers, passes.
enum class Feature : std::uint8_t {
    // Of surfaces.
    diffuse,
    ggx,   ///< glossy reflection by GGX
    phong, ///< glossy reflection by modified Phong
    mirror,
    transmission,
    refraction,     ///< at the border of a solid
    alpha,          ///< light passes some surface
    smooth_normals, ///< interpolated from those of the vertices
    // Of lights.
    point_light,
    spot_light,
    directional_light,
    emissive_triangles,
    sky,
    several_lights, ///< between which is chosen
    // Of paths: what lobes of the scene are followed or estimated (docs/design.md, "Which path is
    // whose").
    followed_paths,
    glossy_estimates, ///< estimated where the surface is not Lambertian
    direct_light,     ///< shadow rays
    // Of the request.
    photon_map,
    differentials, ///< of photons
    caustics,      ///< photons that only followed lobes have scattered
    final_gather
};

/// What of a request matters for that.
struct PlanRequest {
    float follow_roughness = 0.25f; ///< glossy lobes at most this rough are followed
    bool photon_map = true;
    bool footprints = true; ///< of photons
    bool final_gather = false;
    bool everything =
        false; ///< whatever the scene is: to measure and test what doing without it changes
};

/// What a scene and a request require, each with the first object that does: "material 'gold'".
struct Plan {
    PlanRequest request;
    std::map<Feature, std::string> required;

    bool needs(Feature feature) const { return required.contains(feature); }
    /// LOBE_* and MATERIAL_* of shared/bsdf.h.
    std::uint32_t material_features() const;
    /// A bit for each of the lights' kinds, 1 << light_* of shared/light_record.h.
    std::uint32_t light_kinds() const;
};

/// What the scene's triangles, their materials and its lights require; materials of no triangle do
/// not count. What it leaves out changes no bit of any result.
Plan make_plan(const Scene& scene, const PlanRequest& request);

/// A feature for people to read.
struct FeatureText {
    const char* key;  ///< "smooth_normals"
    const char* name; ///< "interpolated normals"
    std::string cost; ///< bytes and passes that it takes, where it is more than code
};
FeatureText text_of(Feature feature);

/// All features, in their order.
std::vector<Feature> all_features();

} // namespace argand
