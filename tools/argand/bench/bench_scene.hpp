#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace argand {

/// Scene of the ray benchmarks: a closed room with bumpy spheres, about 80,000 triangles.
struct BenchScene {
    std::vector<glm::vec4> positions;
    std::vector<glm::uvec4> triangles;
    glm::vec3 eye;
    glm::vec3 target;
    glm::vec3 light;
};

BenchScene make_bench_scene();

/// Camera rays through the pixel centres of a square image, in tiles of 8 x 4 pixels.
struct BenchRays {
    std::vector<glm::vec3> origins;
    std::vector<glm::vec3> directions;
    std::vector<float> ends; ///< t_max
};

BenchRays primary_rays(const BenchScene& scene, std::uint32_t edge);

} // namespace argand
