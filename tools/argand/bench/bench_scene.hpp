#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace argand {

/// What the ray benchmarks look at: a closed room with bumpy spheres, about 80,000 triangles.
struct BenchScene {
    std::vector<glm::vec4> positions;
    std::vector<glm::uvec4> triangles;
    glm::vec3 eye;
    glm::vec3 target;
    glm::vec3 light;
};

BenchScene make_bench_scene();

/// The scene's camera rays through the centres of the pixels of a square picture, in 4 x 8 tiles.
struct BenchRays {
    std::vector<glm::vec3> origins;
    std::vector<glm::vec3> directions;
    std::vector<float> ends; ///< t_max
};

BenchRays primary_rays(const BenchScene& scene, std::uint32_t edge);

} // namespace argand
