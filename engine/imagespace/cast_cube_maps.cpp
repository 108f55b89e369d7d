#include "imagespace/cube_map_making.hpp"
#include "kernels/cube_rays.hpp"
#include "kernels/cube_write.hpp"
#include "shared/cube_map.h"
#include "shared/image_space_records.h"

#include <algorithm>

namespace argand {

namespace {

constexpr std::uint64_t most_rays = 1u << 18; // cast together
// Surfaces through which rays look for one that light does not pass.
constexpr int most_passed = 6;

/// Memory of the rays of one batch.
struct Rays {
    Buffer rays, active, hits;
    Traversal traversal;
};

/// Fills the texels of one batch. Returns false if a ray ran out of iterations.
bool cast(Device& device, const DeviceScene& scene, Rays& w, const CubeMaps& maps,
          const CubeBatch& batch) {
    device.fill(w.traversal.unfinished, 0);
    dispatch(device,
             kernels::cube_rays{
                 .centers = maps.centers, .rays = w.rays, .active_rays = w.active, .batch = batch},
             batch.count);
    const int passed = batch.layers > 1 ? most_passed : 0;
    for (int surface = 0; surface <= passed; ++surface) {
        trace_closest(device, scene.bvh, w.traversal, {w.rays, w.active, w.hits, batch.count});
        dispatch(
            device,
            kernels::cube_write{.triangles = scene.triangles,
                                .materials = scene.materials,
                                .centers = maps.centers,
                                .hits = w.hits,
                                .rays = w.rays,
                                .texels = maps.texels,
                                .batch = batch,
                                .constants = {.material_features = scene.plan.material_features()}},
            batch.count);
    }
    return download_word(device, w.traversal.unfinished) == 0 || w.traversal.careful;
}

} // namespace

void cast_cube_maps(Device& device, const DeviceScene& scene, const CubeMaps& maps) {
    const StageScope stage(device, "cast cube maps");
    const std::uint64_t directions = std::uint64_t(maps.count) * cube_texels(maps.size);
    const std::uint64_t slots =
        std::min({directions, most_rays, device.info().limits.storage_range / sizeof(RayRecord)});
    Rays w{.rays = device.scratch("rays of cube maps", slots * sizeof(RayRecord)),
           .active = device.scratch("active rays of cube maps", slots * sizeof(std::uint32_t)),
           .hits = device.scratch("hits of cube maps", slots * sizeof(HitRecord)),
           .traversal = make_traversal(device, slots)};
    for (std::uint64_t first = 0; first < directions; first += slots) {
        const CubeBatch batch{.first = static_cast<std::uint32_t>(first),
                              .count =
                                  static_cast<std::uint32_t>(std::min(slots, directions - first)),
                              .size = maps.size,
                              .layers = maps.layers,
                              .error = position_error(scene.record),
                              .pad0 = 0,
                              .pad1 = 0,
                              .pad2 = 0};
        w.traversal.careful = false;
        while (!cast(device, scene, w, maps, batch)) {
            w.traversal.careful = true;
        }
    }
}

} // namespace argand
