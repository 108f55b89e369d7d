#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace argand {

/// Scene of the ray benchmarks: a closed room with bumpy spheres.
struct BenchScene {
    std::vector<glm::vec4> positions;
    std::vector<glm::uvec4> triangles;
    glm::vec3 eye;
    glm::vec3 target;
    glm::vec3 light;
};

/// detail: triangles along a wall's edge; four times as many make a circle of a sphere. With 16,
/// there are about 80,000 triangles.
BenchScene make_bench_scene(std::uint32_t detail = 16);

/// Camera rays through the pixel centres of a square image, in tiles of 8 x 4 pixels.
struct BenchRays {
    std::vector<glm::vec3> origins;
    std::vector<glm::vec3> directions;
    std::vector<float> ends; ///< t_max
};

BenchRays primary_rays(const BenchScene& scene, std::uint32_t edge);

} // namespace argand
