#include "plan/plan.hpp"

#include "scene/material_record.hpp"
#include "scene/moving_factors.hpp"
#include "scene/texture_mips.hpp"
#include "scene/texture_range.hpp"
#include "shared/follow.h"
#include "shared/light_record.h"
#include "shared/texture_record.h"

#include <algorithm>
#include <fmt/format.h>
#include <span>
#include <utility>

namespace argand {

namespace {

struct Bit {
    Feature feature;
    std::uint32_t bit;
};

constexpr Bit material_bits[] = {{Feature::diffuse, LOBE_DIFFUSE},
                                 {Feature::ggx, LOBE_GLOSSY | MATERIAL_GGX},
                                 {Feature::phong, LOBE_GLOSSY | MATERIAL_PHONG},
                                 {Feature::mirror, LOBE_MIRROR},
                                 {Feature::transmission, LOBE_TRANSMIT},
                                 {Feature::refraction, LOBE_TRANSMIT | MATERIAL_SOLID},
                                 {Feature::rough_glass, LOBE_CLEAR},
                                 {Feature::absorption, MATERIAL_ABSORPTION},
                                 {Feature::nested_solids, MATERIAL_NESTED},
                                 {Feature::coat, MATERIAL_COAT},
                                 {Feature::rough_coat, LOBE_COAT | MATERIAL_COAT},
                                 {Feature::coat_normal, MATERIAL_COAT_NORMAL},
                                 {Feature::sheen, MATERIAL_SHEEN},
                                 {Feature::anisotropy, MATERIAL_ANISOTROPY},
                                 {Feature::iridescence, MATERIAL_FILM},
                                 {Feature::dispersion, MATERIAL_DISPERSION},
                                 {Feature::unlit, MATERIAL_UNLIT},
                                 {Feature::alpha, MATERIAL_ALPHA}};

constexpr Bit light_bits[] = {{Feature::point_light, 1u << light_point},
                              {Feature::spot_light, 1u << light_spot},
                              {Feature::directional_light, 1u << light_directional},
                              {Feature::emissive_triangles, 1u << light_triangle},
                              {Feature::sky, 1u << light_sky},
                              {Feature::sky_picture, 1u << light_picture}};

std::string named(const char* kind, const std::string& name, std::size_t index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} '{}'", kind, name);
}

/// Collects the required features, each with the name of the first object that requires it.
class Requirements {
public:
    void add(Feature feature, const std::string& by, bool is_required = true) {
        if (is_required) {
            required_.emplace(feature, by);
        }
    }
    std::map<Feature, std::string> take() { return std::move(required_); }
    /// The object that requires a feature, or "".
    std::string by(Feature feature) const {
        const auto found = required_.find(feature);
        return found != required_.end() ? found->second : "";
    }

private:
    std::map<Feature, std::string> required_;
};

/// Adds the features that a material requires. Returns whether it has estimated lobes.
bool add_material(Requirements& requirements, const Material& material, const std::string& by,
                  const PlanRequest& request) {
    const MaterialRecord record = material_record(material);
    const std::uint32_t lobes = bsdf_lobes(record);
    const std::uint32_t estimated = estimated_lobes(record, request.follow_roughness);
    requirements.add(Feature::diffuse, by, (lobes & LOBE_DIFFUSE) != 0);
    requirements.add(Feature::ggx, by, (lobes & LOBE_GLOSSY) != 0 && !is_phong(record));
    requirements.add(Feature::phong, by, is_phong(record));
    requirements.add(Feature::mirror, by, (lobes & LOBE_MIRROR) != 0);
    requirements.add(Feature::transmission, by, (lobes & LOBE_TRANSMIT) != 0);
    requirements.add(Feature::refraction, by, is_solid(record));
    requirements.add(Feature::rough_glass, by, (lobes & LOBE_CLEAR) != 0);
    requirements.add(Feature::absorption, by,
                     is_solid(record) && material.absorption != glm::vec3(0));
    requirements.add(Feature::coat, by, record.coat > 0 && lobes != 0);
    requirements.add(Feature::rough_coat, by, (lobes & LOBE_COAT) != 0);
    requirements.add(Feature::coat_normal, by,
                     (lobes & LOBE_COAT) != 0 &&
                         has_coat_normal(record.absent, coat_normal(record)));
    requirements.add(Feature::sheen, by, has_sheen(record));
    requirements.add(Feature::anisotropy, by,
                     (lobes & LOBE_GLOSSY) != 0 &&
                         is_anisotropic(record.absent, anisotropy(record)));
    requirements.add(Feature::iridescence, by,
                     record.film > 0 && (lobes & (LOBE_GLOSSY | LOBE_MIRROR | LOBE_CLEAR)) != 0);
    requirements.add(Feature::dispersion, by, record.dispersion > 0 && is_solid(record));
    requirements.add(Feature::unlit, by, material.unlit);
    requirements.add(Feature::alpha, by,
                     record.coverage < 1 || (request.cull_back_faces && !material.double_sided));
    requirements.add(Feature::emissive_triangles, by, emits(material));
    requirements.add(Feature::followed_paths, by,
                     followed_lobes(record, request.follow_roughness) != 0);
    requirements.add(Feature::glossy_estimates, by, estimated != 0 && !is_lambertian(record));
    return estimated != 0;
}

/// Calls `add` with a material as it is at rest and at each of its keys.
template <class Add>
void for_each_key(const MovingMaterial& moving, const Material& now, const Add& add) {
    Material material = now;
    set_factors(moving.factors, material);
    add(material);
    for (const double time : key_times(moving.keys)) {
        set_factors(factors_at(moving, time), material);
        add(material);
    }
}

/// Adds the features that surfaces require. Returns whether any has estimated lobes.
bool add_surfaces(Requirements& requirements, const Scene& scene, const SurfaceUse& use,
                  const PlanRequest& request) {
    bool estimated = false;
    for (const std::uint32_t index : use.materials) {
        const Material& material = scene.materials[index];
        const std::string by = named("material", material.name, index);
        const auto add = [&](const Material& at_a_time) {
            requirements.add(Feature::emissive_textures, by,
                             emits(at_a_time) &&
                                 (material.texture_bits & material_emissive_texture) != 0);
            for (const Material& variant : at_extreme_texels(scene, at_a_time)) {
                const bool has_estimated = add_material(requirements, variant, by, request);
                estimated = estimated || has_estimated;
            }
        };
        requirements.add(Feature::textures, by, material.texture_bits != 0);
        requirements.add(Feature::mip_maps, by, has_mips(scene, material));
        requirements.add(Feature::normal_textures, by,
                         (material.texture_bits & material_normal_texture) != 0);
        requirements.add(Feature::other_textures, by,
                         (material.texture_bits & material_other_textures) != 0);
        const MovingMaterial* moving =
            request.at_any_time ? moving_material(scene.motion, index) : nullptr;
        if (moving) {
            for_each_key(*moving, material, add);
        } else {
            add(material);
        }
    }
    requirements.add(Feature::vertex_colors, "the vertices", !scene.colors.empty());
    if (use.solids.overlapping) {
        const auto [a, b] = *use.solids.overlapping;
        const std::string by = named("material", scene.materials[a].name, a) + " beside " +
                               named("material", scene.materials[b].name, b);
        requirements.add(Feature::nested_solids, by);
        requirements.add(Feature::alpha, by); // paths go on behind surfaces that are not there
    }
    if (use.smoothed) {
        requirements.add(Feature::smooth_normals,
                         "surface of " +
                             named("material", scene.materials[*use.smoothed].name, *use.smoothed));
    }
    return estimated;
}

Feature feature_of(LightKind kind) {
    switch (kind) {
    case LightKind::point:
        return Feature::point_light;
    case LightKind::spot:
        return Feature::spot_light;
    case LightKind::directional:
        break;
    }
    return Feature::directional_light;
}

void add_lights(Requirements& requirements, const Scene& scene, const SurfaceUse& use) {
    std::size_t lights = scene.lights.size();
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        requirements.add(feature_of(light.kind), named("light", light.name, i));
    }
    const bool sky = scene.sky && glm::any(glm::greaterThan(*scene.sky, glm::vec3(0)));
    const bool picture =
        !scene.sky && scene.environment &&
        glm::any(glm::greaterThan(mean_radiance(*scene.environment), glm::dvec3(0)));
    requirements.add(Feature::sky, "the sky", sky);
    requirements.add(Feature::sky_picture, "the sky", picture);
    lights += sky || picture ? 1 : 0;
    for (const std::uint32_t material : use.materials) {
        lights += emits(scene.materials[material]) ? use.triangles[material] : 0;
    }
    requirements.add(Feature::several_lights, fmt::format("{} lights", lights), lights > 1);
}

/// Name of the first light, or "".
std::string first_light(const Requirements& requirements) {
    for (const Bit& light : light_bits) {
        if (std::string by = requirements.by(light.feature); !by.empty()) {
            return by;
        }
    }
    return "";
}

std::uint32_t bits_of(const Plan& plan, std::span<const Bit> bits) {
    std::uint32_t sum = 0;
    for (const Bit& bit : bits) {
        sum |= plan.needs(bit.feature) ? bit.bit : 0u;
    }
    return sum;
}

bool allows(const PlanRequest& request, Feature feature) {
    switch (feature) {
    case Feature::photon_map:
        return request.photon_map;
    case Feature::light_paths:
        return request.light_paths;
    case Feature::caustics:
        return request.photon_map || request.light_paths;
    case Feature::differentials:
        return request.photon_map && request.footprints;
    case Feature::cube_maps:
        return request.photon_map && request.cube_maps;
    case Feature::final_gather:
        return request.photon_map && request.final_gather;
    default:
        return true;
    }
}

} // namespace

std::uint32_t Plan::material_features() const { return bits_of(*this, material_bits); }

std::uint32_t Plan::light_kinds() const { return bits_of(*this, light_bits); }

Plan make_plan(const Scene& scene, const PlanRequest& request) {
    return make_plan(scene, surface_use(scene), request);
}

Plan make_plan(const Scene& scene, const SurfaceUse& use, const PlanRequest& request) {
    Requirements found;
    const bool estimated = add_surfaces(found, scene, use, request);
    add_lights(found, scene, use);
    const std::string light = first_light(found);
    const auto has = [&](Feature feature) { return !found.by(feature).empty(); };
    // Delta lobes cannot use light samples.
    const bool rough = has(Feature::diffuse) || has(Feature::ggx) || has(Feature::phong) ||
                       has(Feature::rough_glass) || has(Feature::rough_coat);
    found.add(Feature::direct_light, light, !light.empty() && rough);
    found.add(Feature::photon_map, "the method");
    found.add(Feature::light_paths, "the method", estimated); // what they are connected by
    found.add(Feature::differentials, "the method");
    found.add(Feature::caustics, found.by(Feature::followed_paths),
              has(Feature::followed_paths) && estimated);
    found.add(Feature::cube_maps, "the method");
    found.add(Feature::final_gather, "the request");
    for (const Feature feature : all_features()) {
        found.add(feature, "the request", request.everything);
    }
    Plan plan{request, found.take()};
    std::erase_if(plan.required, [&](const auto& entry) { return !allows(request, entry.first); });
    return plan;
}

} // namespace argand
