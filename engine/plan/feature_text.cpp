#include "plan/plan.hpp"

#include "shared/differential_record.h"
#include "shared/geometry_records.h"
#include "shared/light_path_records.h"
#include "shared/path_records.h"
#include "shared/photon_records.h"
#include "shared/query_record.h"
#include "shared/scene_records.h"
#include "shared/sky_record.h"
#include "shared/texture.h"
#include "shared/texture_record.h"

#include <fmt/format.h>

namespace argand {

// NOLINTNEXTLINE(readability-function-size): a table, of which the compiler tells what is missing
FeatureText text_of(Feature feature) {
    constexpr std::size_t lane = 4 * sizeof(float);
    constexpr std::size_t word = sizeof(std::uint32_t);
    switch (feature) {
    case Feature::diffuse:
        return {"diffuse", "diffuse reflection", ""};
    case Feature::ggx:
        return {"ggx", "glossy reflection, GGX", ""};
    case Feature::phong:
        return {"phong", "glossy reflection, Phong", ""};
    case Feature::mirror:
        return {"mirror", "mirrors", ""};
    case Feature::transmission:
        return {"transmission", "transmission", ""};
    case Feature::refraction:
        return {"refraction", "refraction", ""};
    case Feature::rough_glass:
        return {"rough_glass", "rough transmission", ""};
    case Feature::absorption:
        return {"absorption", "absorption inside solids", ""};
    case Feature::nested_solids:
        return {"nested_solids", "solids that may overlap",
                "every interface reads the material of the solid around it, and rays that of every "
                "triangle that they meet"};
    case Feature::coat:
        return {"coat", "coats", ""};
    case Feature::rough_coat:
        return {"rough_coat", "rough coats", ""};
    case Feature::coat_normal:
        return {"coat_normal", "coats with normals of their own", ""};
    case Feature::sheen:
        return {"sheen", "sheen", ""};
    case Feature::anisotropy:
        return {"anisotropy", "anisotropic gloss", ""};
    case Feature::iridescence:
        return {"iridescence", "thin films", ""};
    case Feature::dispersion:
        return {"dispersion", "dispersion", ""};
    case Feature::unlit:
        return {"unlit", "unlit surfaces", ""};
    case Feature::alpha:
        return {"alpha", "alpha",
                "rays read the material of every triangle that they meet, and shadow rays go on "
                "through all that let light pass"};
    case Feature::smooth_normals:
        return {"smooth_normals", "interpolated normals",
                fmt::format("{} bytes per vertex; every hit reads three vertices", lane)};
    case Feature::textures:
        return {"textures", "textures",
                fmt::format("{} bytes per texel, {} per vertex; every hit reads three vertices and "
                            "four texels of each texture",
                            word, 2 * word)};
    case Feature::vertex_colors:
        return {"vertex_colors", "colours of vertices",
                fmt::format("{} bytes per vertex; every hit reads three vertices", 2 * word)};
    case Feature::emissive_textures:
        return {"emissive_textures", "emissive textures",
                fmt::format("at most {} KiB; every sample of a light that shines by texels walks "
                            "down a tree",
                            most_texel_tree_words * word / 1024)};
    case Feature::mip_maps:
        return {"mip_maps", "mip maps",
                fmt::format("{} bytes per texel; a hit reads up to eight texels",
                            fmt::format("{:.1f}", double(words_of_mip * word) / 3))};
    case Feature::normal_textures:
        return {"normal_textures", "normal textures",
                fmt::format("{} bytes per triangle; every hit on one reads its tangents and four "
                            "texels",
                            4 * word)};
    case Feature::other_textures:
        return {"other_textures", "textures of specular reflection and transmission",
                "every hit on one reads four texels of each"};
    case Feature::point_light:
        return {"point_light", "point lights", ""};
    case Feature::spot_light:
        return {"spot_light", "spot lights", ""};
    case Feature::directional_light:
        return {"directional_light", "directional lights", ""};
    case Feature::emissive_triangles:
        return {"emissive_triangles", "emissive triangles", ""};
    case Feature::sky:
        return {"sky", "uniform sky", ""};
    case Feature::sky_picture:
        return {"sky_picture", "picture of the sky",
                fmt::format("{} bytes per texel; every ray that leaves the scene, and every sample "
                            "of the sky, reads four texels",
                            (sky_texel_words + 1) * word)};
    case Feature::several_lights:
        return {"several_lights", "choice among lights",
                fmt::format("{} bytes per light", 2 * sizeof(LightChoice))};
    case Feature::followed_paths:
        return {"followed_paths", "followed paths",
                "a round of tracing and shading for every surface that a path meets"};
    case Feature::glossy_estimates:
        return {"glossy_estimates", "estimates on non-Lambertian surfaces",
                fmt::format("the BSDF is evaluated for every photon of an estimate; {} bytes per "
                            "eye path",
                            sizeof(QueryBsdfRecord))};
    case Feature::direct_light:
        return {"direct_light", "shadow rays",
                fmt::format("a ray at every eye vertex; {} bytes per eye path",
                            sizeof(RayRecord) + sizeof(ShadowRecord) + word)};
    case Feature::photon_map:
        return {"photon_map", "photon map",
                fmt::format("{} bytes per stored photon, {} per eye path",
                            2 * sizeof(PhotonRecord) + 3 * word,
                            sizeof(QueryRecord) + sizeof(EstimateRecord) + sizeof(GatherRecord) +
                                4 * word)};
    case Feature::light_paths:
        return {"light_paths", "light paths",
                fmt::format("a shadow ray for every hit of a photon; {} bytes per traced photon, "
                            "{} per eye path",
                            sizeof(LightPathRecord) + sizeof(RayRecord) + sizeof(SplatRecord) +
                                3 * word,
                            sizeof(EyeWeightRecord))};
    case Feature::differentials:
        return {"differentials", "photon differentials",
                fmt::format("{} bytes per traced photon, {} per stored photon",
                            sizeof(DifferentialRecord), 2 * lane)};
    case Feature::caustics:
        return {"caustics", "caustic photons", "every eye path queries them separately"};
    case Feature::cube_maps:
        return {"cube_maps", "cube maps",
                fmt::format("{} bytes per texel, for each of three layers where light passes "
                            "surfaces",
                            2 * word)};
    case Feature::final_gather:
        return {"final_gather", "final gather",
                "a round of tracing and shading before the photon map is queried"};
    }
    return {"", "", ""};
}

std::vector<Feature> all_features() {
    std::vector<Feature> features;
    for (int i = 0; i <= static_cast<int>(Feature::final_gather); ++i) {
        features.push_back(static_cast<Feature>(i));
    }
    return features;
}

} // namespace argand
