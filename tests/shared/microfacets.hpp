#pragma once

#include <cmath>
#include <functional>
#include <glm/glm.hpp>

namespace argand::testing {

/// GGX microfacets as appendix B of the glTF specification has them, in double precision and
/// written independently of shaders/shared.
namespace appendix_b {

constexpr double pi = 3.14159265358979323846;

/// Distribution of normals [1/sr] over the cosine of the half vector.
inline double distribution(double alpha, double cosine) {
    const double a2 = alpha * alpha;
    const double f = cosine * cosine * (a2 - 1) + 1;
    return a2 / (pi * f * f);
}

/// G / (4 cos θi cos θo).
inline double visibility(double alpha, double cosine_o, double cosine_i) {
    const double a2 = alpha * alpha;
    return 0.5 / (cosine_i * std::sqrt(cosine_o * cosine_o * (1 - a2) + a2) +
                  cosine_o * std::sqrt(cosine_i * cosine_i * (1 - a2) + a2));
}

/// Share of light from a direction of this cosine that single reflection by microfacets returns,
/// whose reflectance is a function of the cosine with their normal. Midpoint rule over half
/// vectors: azimuth, and the share of normals closer to the surface's normal.
inline double albedo(double alpha, double cosine, const std::function<double(double)>& fresnel,
                     int rows = 400, int columns = 200) {
    const glm::dvec3 o(std::sqrt(1 - cosine * cosine), 0, cosine);
    double sum = 0;
    for (int row = 0; row < rows; ++row) {
        const double rest = 1 - (row + 0.5) / rows; // square root of the share farther away
        const double tan2 = alpha * alpha * (1 / (rest * rest) - 1);
        const double z = 1 / std::sqrt(1 + tan2);
        // d tan²/d row, solid angle of h by tan² and azimuth, solid angle of i over that of h
        const double measure = 2 * alpha * alpha / (rest * rest * rest) * z * z * z / 2 * 4;
        for (int column = 0; column < columns; ++column) {
            const double around = pi * (column + 0.5) / columns;
            const glm::dvec3 h(std::sqrt(tan2) * z * std::cos(around),
                               std::sqrt(tan2) * z * std::sin(around), z);
            const double c = glm::dot(o, h);
            const double i = 2 * c * h.z - o.z;
            if (c > 0 && i > 0) {
                sum += fresnel(std::min(c, 1.0)) * distribution(alpha, z) *
                       visibility(alpha, cosine, i) * i * c * measure;
            }
        }
    }
    return sum * 2 * pi / (rows * columns);
}

} // namespace appendix_b
} // namespace argand::testing
