#pragma once

#include "scene/scene.hpp"
#include "ywcyp10.hpp"

namespace argand {

PaperTable bench_cube_making(Device& device);
PaperTable bench_cube_images(Device& device, const Ywcyp10Settings& settings);
PaperTable bench_cube_hits(Device& device, const Ywcyp10Settings& settings);

/// The scene of the ray benchmarks, all white, with a point light and a camera; 316 detail²
/// triangles.
Scene make_room_of_spheres(std::uint32_t detail);

} // namespace argand
