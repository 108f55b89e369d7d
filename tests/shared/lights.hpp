#pragma once

#include "numbers.hpp"
#include "oracle.hpp"
#include "shared/lights.h"

#include <random>

namespace argand::testing {

inline LightRecord light(uint kind, vec3 color) {
    LightRecord l{};
    l.kind = kind;
    l.r = color.x;
    l.g = color.y;
    l.b = color.z;
    return l;
}

inline LightRecord point_light(vec3 position, vec3 intensity) {
    LightRecord l = light(light_point, intensity);
    l.x = position.x;
    l.y = position.y;
    l.z = position.z;
    return l;
}

inline LightRecord directional_light(vec3 direction, vec3 irradiance) {
    LightRecord l = light(light_directional, irradiance);
    l.dx = direction.x;
    l.dy = direction.y;
    l.dz = direction.z;
    return l;
}

/// Angles in degrees.
inline LightRecord spot_light(vec3 position, vec3 direction, vec3 intensity, double inner,
                              double outer) {
    LightRecord l = point_light(position, intensity);
    l.kind = light_spot;
    l.dx = direction.x;
    l.dy = direction.y;
    l.dz = direction.z;
    l.cos_inner = float(std::cos(inner * 0.017453292519943295));
    l.cos_outer = float(std::cos(outer * 0.017453292519943295));
    return l;
}

inline LightRecord triangle_light(vec3 a, vec3 b, vec3 c, vec3 radiance, bool double_sided) {
    LightRecord l = point_light(a, radiance);
    l.kind = light_triangle;
    l.dx = b.x;
    l.dy = b.y;
    l.dz = b.z;
    l.ex = c.x;
    l.ey = c.y;
    l.ez = c.z;
    l.triangle_and_sides = double_sided ? 1 : 0;
    return l;
}

/// Overloads for any kind of light, like kernels that are not specialised to a scene's lights.
inline bool light_sample(const LightRecord& l, vec3 p, vec2 u, LightSample& s) {
    return argand::light_sample(l, all_light_kinds, p, u, s);
}
inline vec3 light_power(const LightRecord& l, float radius) {
    return argand::light_power(l, all_light_kinds, radius);
}
inline bool light_emit(const LightRecord& l, const Sphere& bounds, vec4 u, vec4 v,
                       EmittedPhoton& p) {
    return argand::light_emit(l, all_light_kinds, bounds, u, v, p);
}

inline truth::Record record_bytes(const LightRecord& l) { return std::bit_cast<truth::Record>(l); }

} // namespace argand::testing
