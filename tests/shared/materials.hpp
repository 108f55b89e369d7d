#pragma once

#include "numbers.hpp"
#include "oracle.hpp"
#include "scene/scene.hpp"
#include "shared/bsdf.h"

#include <random>

namespace argand::testing {

/// glTF's default material, but rough and not metallic.
inline MaterialRecord white_dielectric() {
    MaterialRecord m{};
    m.base_r = m.base_g = m.base_b = 1;
    m.specular_r = m.specular_g = m.specular_b = 1;
    m.specular = 1;
    m.roughness = 1;
    m.ior = 1.5f;
    m.coverage = 1;
    m.exponent = -1;
    return m;
}

inline MaterialRecord with_alpha(MaterialRecord m, float alpha) {
    m.coverage = alpha;
    return m;
}

inline MaterialRecord with_color(MaterialRecord m, vec3 color) {
    m.base_r = color.x;
    m.base_g = color.y;
    m.base_b = color.z;
    return m;
}

inline MaterialRecord lambertian(vec3 color) {
    MaterialRecord m = with_color(white_dielectric(), color);
    m.specular = 0;
    return m;
}

inline MaterialRecord metal(vec3 color, float roughness) {
    MaterialRecord m = with_color(white_dielectric(), color);
    m.metallic = 1;
    m.roughness = roughness;
    return m;
}

inline MaterialRecord glossy_dielectric(float roughness) {
    MaterialRecord m = with_color(white_dielectric(), vec3(0.8f, 0.5f, 0.2f));
    m.roughness = roughness;
    return m;
}

/// thickness 0: a thin wall.
inline MaterialRecord glass(float ior, float thickness) {
    MaterialRecord m = white_dielectric();
    m.roughness = 0;
    m.transmission = 1;
    m.ior = ior;
    m.thickness = thickness;
    return m;
}

inline MaterialRecord phong(vec3 diffuse, vec3 specular, float exponent) {
    MaterialRecord m = with_color(white_dielectric(), diffuse);
    m.specular_r = specular.x;
    m.specular_g = specular.y;
    m.specular_b = specular.z;
    m.specular = specular == vec3(0) ? 0 : 1;
    m.exponent = exponent;
    m.roughness = roughness_of_phong(exponent);
    return m;
}

inline MaterialRecord any_phong(std::mt19937& bits) {
    std::uniform_real_distribution<float> uniform;
    const vec3 sum(uniform(bits), uniform(bits), uniform(bits));
    const float split = bits() % 3 == 0 ? float(bits() % 2) : uniform(bits);
    const float exponent = bits() % 8 == 0 ? 0 : std::exp(uniform(bits) * 16);
    MaterialRecord m = phong(sum * split, sum * (1 - split), exponent);
    m.coverage = bits() % 2 == 0 ? 1 : uniform(bits);
    return m;
}

inline MaterialRecord any_material(std::mt19937& bits) {
    std::uniform_real_distribution<float> uniform;
    const auto end_or_between = [&] { return bits() % 3 == 0 ? float(bits() % 2) : uniform(bits); };
    MaterialRecord m =
        with_color(white_dielectric(), vec3(uniform(bits), uniform(bits), uniform(bits)));
    m.metallic = end_or_between();
    m.roughness = end_or_between();
    m.specular = end_or_between();
    m.specular_r = 2 * uniform(bits);
    m.transmission = end_or_between();
    m.ior = 1 + uniform(bits);
    m.thickness = float(bits() % 2);
    m.coverage = bits() % 2 == 0 ? 1 : uniform(bits);
    return m;
}

/// The same under a coat, sheen and a thin film.
inline MaterialRecord any_coated(std::mt19937& bits) {
    std::uniform_real_distribution<float> uniform;
    MaterialRecord m = any_material(bits);
    m.coat = bits() % 2 == 0 ? 1 : uniform(bits);
    m.coat_roughness = bits() % 3 == 0 ? 0 : uniform(bits);
    m.sheen_r = m.sheen_g = bits() % 2 == 0 ? 0 : uniform(bits);
    m.sheen_roughness = uniform(bits);
    m.film = bits() % 2 == 0 ? 0 : uniform(bits);
    m.film_ior = 1 + uniform(bits);
    m.film_thickness = 0.1f + uniform(bits);
    return m;
}

/// A number as the renderer's random streams produce it.
inline float to_unit_float(std::mt19937& bits) { return float(bits() >> 8) * 0x1p-24f; }

/// A direction at an angle [degrees] to the normal.
inline vec3 at_angle(double degrees, double around = 0) {
    const double theta = degrees * 0.017453292519943295;
    const double phi = around * 0.017453292519943295;
    return rounded(
        {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
}

/// A direction above the surface; every fourth is grazing.
inline vec3 any_upper(std::mt19937& bits) {
    std::normal_distribution<double> normal;
    glm::dvec3 v(normal(bits), normal(bits), std::abs(normal(bits)) + 1e-9);
    if (bits() % 4 == 0) {
        v.z *= std::exp2(-20 * std::uniform_real_distribution<double>()(bits));
    }
    return rounded(glm::normalize(v));
}

inline truth::MaterialBytes record_bytes(const MaterialRecord& m) {
    return std::bit_cast<truth::MaterialBytes>(m);
}

} // namespace argand::testing
