#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>

namespace argand {

struct Light;
struct Material;

/// How alpha acts (glTF 2.0, section 3.9.4).
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// The numbers of a material as its file states them. A Material follows from them.
struct MaterialFactors {
    glm::dvec4 base_color{1}; ///< and alpha
    double metallic = 1, roughness = 1;
    AlphaMode alpha_mode = AlphaMode::opaque;
    double alpha_cutoff = 0.5;
    glm::dvec3 emissive{0}; ///< times the strength: radiance [cd/m²]
    double emissive_strength = 1;
    double specular = 1;
    glm::dvec3 specular_color{1};
    double transmission = 0, ior = 1.5, thickness = 0;
    glm::dvec3 attenuation_color{1};
    double attenuation_distance = std::numeric_limits<double>::infinity();
    double coat = 0, coat_roughness = 0; ///< KHR_materials_clearcoat
    double dispersion = 0;
    double iridescence = 0, iridescence_ior = 1.3, iridescence_thickness = 400; ///< [nanometres]
    glm::dvec3 sheen_color{0};
    double sheen_roughness = 0;
    double anisotropy = 0, anisotropy_rotation = 0; ///< strength; [rad] from the tangent
    bool unlit = false;
};

/// The numbers of a light as its file states them. A Light follows from them.
struct LightFactors {
    glm::dvec3 color{1};
    double intensity = 1; ///< [cd], directional: [lux]
    double inner_cone_angle = 0, outer_cone_angle = std::numbers::pi / 4; ///< [rad] spot
};

/// Gives a material these factors, each clamped to its range. Name, sides and Phong lobe stay; a
/// Phong lobe limits the base colour. An index of refraction that is not 0 becomes at least 1.
void set_factors(const MaterialFactors& factors, Material& material);

/// Gives a light these factors, each clamped to its range. Name, kind and place stay.
void set_factors(const LightFactors& factors, Light& light);

} // namespace argand
