#include "scene/moving_factors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace argand {
namespace {

using OptionalKeys = std::optional<KeyFrames>;

void move_number(const OptionalKeys& keys, double seconds, double& number) {
    if (keys) {
        number = value_at(*keys, seconds)[0];
    }
}

void move_vector(const OptionalKeys& keys, double seconds, glm::dvec3& vector) {
    if (keys) {
        const std::vector<double> value = value_at(*keys, seconds);
        vector = {value[0], value[1], value[2]};
    }
}

bool rises_above_zero(const OptionalKeys& keys) {
    return keys && std::any_of(keys->values.begin(), keys->values.end(),
                               [](double value) { return value > 0; });
}

} // namespace

LightFactors factors_at(const LightKeys& keys, const LightFactors& rest, double seconds) {
    LightFactors factors = rest;
    move_vector(keys.color, seconds, factors.color);
    move_number(keys.intensity, seconds, factors.intensity);
    if (keys.color || keys.intensity) {
        // Two splines that overshoot below 0 must not have a product above 0.
        factors.color = glm::max(factors.color, glm::dvec3(0));
    }
    move_number(keys.inner_cone_angle, seconds, factors.inner_cone_angle);
    move_number(keys.outer_cone_angle, seconds, factors.outer_cone_angle);
    return factors;
}

MaterialFactors factors_at(const MovingMaterial& material, double seconds) {
    const MaterialKeys& keys = material.keys;
    MaterialFactors factors = material.factors;
    if (keys.base_color) {
        const std::vector<double> value = value_at(*keys.base_color, seconds);
        factors.base_color = {value[0], value[1], value[2], value[3]};
    }
    move_number(keys.metallic, seconds, factors.metallic);
    move_number(keys.roughness, seconds, factors.roughness);
    move_number(keys.alpha_cutoff, seconds, factors.alpha_cutoff);
    move_vector(keys.emissive, seconds, factors.emissive);
    move_number(keys.emissive_strength, seconds, factors.emissive_strength);
    move_number(keys.specular, seconds, factors.specular);
    move_vector(keys.specular_color, seconds, factors.specular_color);
    move_number(keys.transmission, seconds, factors.transmission);
    move_number(keys.ior, seconds, factors.ior);
    move_number(keys.thickness, seconds, factors.thickness);
    move_vector(keys.attenuation_color, seconds, factors.attenuation_color);
    move_number(keys.attenuation_distance, seconds, factors.attenuation_distance);
    move_number(keys.coat, seconds, factors.coat);
    move_number(keys.coat_roughness, seconds, factors.coat_roughness);
    move_number(keys.dispersion, seconds, factors.dispersion);
    move_vector(keys.sheen_color, seconds, factors.sheen_color);
    move_number(keys.sheen_roughness, seconds, factors.sheen_roughness);
    move_number(keys.anisotropy, seconds, factors.anisotropy);
    move_number(keys.anisotropy_rotation, seconds, factors.anisotropy_rotation);
    move_number(keys.iridescence, seconds, factors.iridescence);
    move_number(keys.iridescence_ior, seconds, factors.iridescence_ior);
    move_number(keys.iridescence_thickness, seconds, factors.iridescence_thickness);
    return factors;
}

void set_view(const CameraKeys& keys, double seconds, Camera& camera) {
    constexpr float smallest = std::numeric_limits<float>::min(); // above 0
    if (keys.vertical_angle) {
        const float below_pi = std::nextafter(std::numbers::pi_v<float>, 0.0f);
        camera.vertical_angle = static_cast<float>(
            std::clamp<double>(value_at(*keys.vertical_angle, seconds)[0], smallest, below_pi));
    }
    if (keys.vertical_extent) {
        // Negative values would mirror the image, as at rest.
        camera.vertical_extent = static_cast<float>(
            std::clamp<double>(std::abs(value_at(*keys.vertical_extent, seconds)[0]), smallest,
                               std::numeric_limits<float>::max()));
    }
}

const MovingMaterial* moving_material(const Motion& motion, std::size_t index) {
    const auto found = std::lower_bound(
        motion.materials.begin(), motion.materials.end(), index,
        [](const MovingMaterial& material, std::size_t at) { return material.index < at; });
    return found != motion.materials.end() && found->index == index ? &*found : nullptr;
}

std::vector<double> key_times(const MaterialKeys& keys) {
    std::vector<double> times;
    for (const OptionalKeys* property : {&keys.base_color,
                                         &keys.metallic,
                                         &keys.roughness,
                                         &keys.alpha_cutoff,
                                         &keys.emissive,
                                         &keys.emissive_strength,
                                         &keys.specular,
                                         &keys.specular_color,
                                         &keys.transmission,
                                         &keys.ior,
                                         &keys.thickness,
                                         &keys.attenuation_color,
                                         &keys.attenuation_distance,
                                         &keys.coat,
                                         &keys.coat_roughness,
                                         &keys.dispersion,
                                         &keys.sheen_color,
                                         &keys.sheen_roughness,
                                         &keys.anisotropy,
                                         &keys.anisotropy_rotation,
                                         &keys.iridescence,
                                         &keys.iridescence_ior,
                                         &keys.iridescence_thickness}) {
        if (*property) {
            times.insert(times.end(), (*property)->times.begin(), (*property)->times.end());
        }
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

bool may_be_visible(const Scene& scene, std::size_t material) {
    const MovingMaterial* moving = moving_material(scene.motion, material);
    return scene.materials[material].coverage > 0 || (moving && moving->keys.moves_alpha());
}

bool may_emit(const Scene& scene, std::size_t material) {
    const MovingMaterial* moving = moving_material(scene.motion, material);
    if (emits(scene.materials[material]) || !moving) {
        return emits(scene.materials[material]);
    }
    const MaterialFactors& rest = moving->factors;
    const bool has_color = glm::any(glm::greaterThan(rest.emissive, glm::dvec3(0))) ||
                           rises_above_zero(moving->keys.emissive);
    const bool has_strength =
        rest.emissive_strength > 0 || rises_above_zero(moving->keys.emissive_strength);
    return has_color && has_strength && may_be_visible(scene, material);
}

} // namespace argand
