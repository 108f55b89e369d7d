#include "device/raster.hpp"
#include "imagespace/cube_map_making.hpp"
#include "kernels/cube_faces.hpp"
#include "shared/cube_map.h"
#include "shared/image_space_records.h"

#include <algorithm>
#include <bit>

namespace argand {

namespace {

// What is not drawn because it is too near to a center, in the scene's radius. Depths are floats,
// so they are as precise for any value.
constexpr float nearest_in_radii = 1e-10f;
// Of maps that are drawn together: their image takes half as much again, for depths.
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 25;

} // namespace

void draw_cube_maps(Device& device, const DeviceScene& scene, const CubeMaps& maps) {
    const StageScope stage(device, "draw cube maps");
    const std::uint64_t bytes = std::uint64_t(cube_texels(maps.size)) * sizeof(glm::uvec2);
    const Buffer none = unneeded(device);
    kernels::cube_faces program{.positions = scene.positions,
                                .centers = maps.centers,
                                .shown = maps.layers > 1 ? maps.texels : none,
                                .alpha = alpha_bindings(scene),
                                .params = {},
                                .constants = {.material_features = scene.plan.material_features(),
                                              .alpha = alpha_constants(scene)}};
    // The layers of one map lie together, so maps of several are drawn one by one. Each layer
    // leaves out what those before it show.
    std::uint32_t together = 1;
    if (maps.layers == 1) {
        const auto fitting =
            static_cast<std::uint32_t>(std::max<std::uint64_t>(most_bytes / bytes, 1));
        together = std::min({maps.count, device.info().limits.layers / cube_faces, fitting});
    }
    for (std::uint32_t layer = 0; layer < maps.layers; ++layer) {
        for (std::uint32_t first = 0; first < maps.count; first += together) {
            const std::uint32_t count = std::min(together, maps.count - first);
            program.params = {.first = first,
                              .layer = layer,
                              .layers = maps.layers,
                              .size = maps.size,
                              .nearest = nearest_in_radii * scene.record.radius,
                              .error = position_error(scene.record)};
            const std::uint64_t place = (std::uint64_t(first) * maps.layers + layer) * bytes;
            draw(*device.raster(), program, 3 * scene.record.triangle_count,
                 {.to = BufferView(maps.texels, place, count * bytes),
                  .width = maps.size,
                  .height = maps.size,
                  .layers = count * cube_faces,
                  .empty = {no_triangle, std::bit_cast<std::uint32_t>(far_away)}});
        }
    }
}

} // namespace argand
