// Include in double precision only.
#pragma once

#include "shared/maths.h"

namespace argand::oracle {

/// Factor by which a map of the unit square stretches area at u, by central differences.
template <class F> double stretch(const F& map, vec2 u) {
    const double h = 1e-6;
    const vec3 x = (map(u + vec2(h, 0)) - map(u - vec2(h, 0))) / (2 * h);
    const vec3 y = (map(u + vec2(0, h)) - map(u - vec2(0, h))) / (2 * h);
    return glm::length(glm::cross(x, y));
}

inline double area_of(vec3 u, vec3 v) { return glm::length(glm::cross(u, v)); }

} // namespace argand::oracle
