#include "scene/factors.hpp"

#include "scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {
namespace {

constexpr double largest_float = std::numeric_limits<float>::max();
// Films of more than a tenth of a millimetre interfere no more. [micrometres]
constexpr double largest_film = 100;
// Beyond it, red has an index of 1.
constexpr double largest_dispersion = 40;
constexpr double smallest_float = std::numeric_limits<float>::min(); // above 0

float clamped(double value, double high) {
    return static_cast<float>(std::clamp(value, 0.0, high));
}

glm::vec3 clamped(const glm::dvec3& value, double high) {
    return {clamped(value.x, high), clamped(value.y, high), clamped(value.z, high)};
}

/// Alpha as the mode interprets it.
float coverage_of(const MaterialFactors& factors) {
    const float alpha = clamped(factors.base_color.a, 1);
    switch (factors.alpha_mode) {
    case AlphaMode::opaque:
        return 1;
    case AlphaMode::mask:
        return alpha >= clamped(factors.alpha_cutoff, largest_float) ? 1.0f : 0.0f;
    case AlphaMode::blend:
        break;
    }
    return alpha;
}

/// What remains of light after the distance is the colour. [1/length]
glm::vec3 absorption_of(const MaterialFactors& factors) {
    const double distance = std::max(factors.attenuation_distance, smallest_float);
    glm::vec3 absorption(0);
    for (int channel = 0; channel < 3; ++channel) {
        const double color = std::clamp(factors.attenuation_color[channel], 0.0, 1.0);
        absorption[channel] =
            std::isinf(distance) ? 0.0f : clamped(-std::log(color) / distance, largest_float);
    }
    return absorption;
}

/// The least product of the alpha of texels and vertices with which a masked surface is present.
float alpha_threshold(const MaterialFactors& factors) {
    const float alpha = clamped(factors.base_color.a, 1);
    return alpha > 0 ? clamped(factors.alpha_cutoff, largest_float) / alpha : 1.0f;
}

} // namespace

void set_factors(const MaterialFactors& factors, Material& material) {
    material.base_color = clamped(glm::dvec3(factors.base_color), 1);
    if (material.phong) {
        // Together they reflect at most all light.
        material.base_color = glm::min(material.base_color, 1.0f - material.phong->specular);
    }
    material.metallic = clamped(factors.metallic, 1);
    material.roughness = clamped(factors.roughness, 1);
    material.coverage = coverage_of(factors);
    material.alpha_mode = factors.alpha_mode;
    material.alpha_threshold =
        factors.alpha_mode == AlphaMode::mask ? alpha_threshold(factors) : 0.0f;
    const glm::dvec3 emissive(glm::max(factors.emissive, glm::dvec3(0)));
    material.emission = clamped(emissive * std::max(factors.emissive_strength, 0.0), largest_float);
    material.emission *= material.coverage;
    material.specular = clamped(factors.specular, 1);
    material.specular_color = clamped(factors.specular_color, largest_float);
    material.transmission = clamped(factors.transmission, 1);
    material.ior =
        factors.ior == 0 ? 0.0f : static_cast<float>(std::clamp(factors.ior, 1.0, largest_float));
    material.thickness = clamped(factors.thickness, largest_float);
    material.absorption = absorption_of(factors);
    material.coat = clamped(factors.coat, 1);
    material.coat_roughness = clamped(factors.coat_roughness, 1);
    material.dispersion = clamped(factors.dispersion, largest_dispersion);
    material.film = clamped(factors.iridescence, 1);
    material.film_ior = static_cast<float>(std::clamp(factors.iridescence_ior, 1.0, largest_float));
    material.film_thickness = clamped(factors.iridescence_thickness * 1e-3, largest_film);
    material.sheen_color = clamped(factors.sheen_color, 1);
    material.sheen_roughness = clamped(factors.sheen_roughness, 1);
    const double strength = std::clamp(factors.anisotropy, 0.0, 1.0);
    material.anisotropy = glm::dvec2(strength * std::cos(factors.anisotropy_rotation),
                                     strength * std::sin(factors.anisotropy_rotation));
    material.unlit = factors.unlit;
    if (material.unlit) {
        material.emission = glm::vec3(0); // only the base colour counts
    }
}

void set_factors(const LightFactors& factors, Light& light) {
    light.intensity = clamped(factors.color * factors.intensity, largest_float);
    const double outer = std::clamp(factors.outer_cone_angle, smallest_float, std::numbers::pi / 2);
    light.outer_cone_angle = static_cast<float>(outer);
    light.inner_cone_angle =
        std::min(clamped(factors.inner_cone_angle, outer), light.outer_cone_angle);
}

} // namespace argand
