#include "imagespace/cube_maps.hpp"

#include "kernels/cube_rays.hpp"
#include "kernels/cube_trace.hpp"
#include "kernels/cube_write.hpp"
#include "parallel/parts.hpp"
#include "shared/bsdf.h"
#include "shared/cube_map.h"
#include "shared/image_space_records.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace argand {

namespace {

constexpr std::uint64_t most_rays = 1u << 18; // cast together
// Surfaces through which rays look for one that light does not pass.
constexpr int most_passed = 6;

// Rays are looked at in the scene's box and so far around it, in its radii: behind a wall on its
// edge.
constexpr float box_margin = 0.005f;

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

std::uint32_t layers_of(const DeviceScene& scene) {
    return (scene.plan.material_features() & (LOBE_TRANSMIT | LOBE_CLEAR | MATERIAL_ALPHA)) != 0
               ? most_layers
               : 1;
}

std::uint64_t max_cube_texels(const Device& device) {
    // Texels are numbered in 32 bits.
    return std::min<std::uint64_t>(device.info().limits.storage_range / sizeof(glm::uvec2),
                                   std::numeric_limits<std::uint32_t>::max());
}

kernels::CubeBindings cube_bindings(const DeviceScene& scene, const CubeMaps& maps) {
    return {.texels = maps.texels,
            .centers = maps.centers,
            .positions = scene.positions,
            .triangles = scene.triangles};
}

CubeMaps cast_cube_maps(Device& device, const DeviceScene& scene,
                        std::span<const glm::vec3> centers, std::uint32_t size,
                        std::uint32_t layers) {
    const StageScope stage(device, "cast cube maps");
    const std::uint64_t directions = centers.size() * cube_texels(size);
    std::vector<glm::vec4> places;
    for (const glm::vec3& center : centers) {
        places.emplace_back(center, 0);
    }
    CubeMaps maps{.texels = device.allocate("cube maps", directions * layers * sizeof(glm::uvec2)),
                  .centers = upload(device, "centers of cube maps", places),
                  .count = static_cast<std::uint32_t>(centers.size()),
                  .layers = layers,
                  .size = size};
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
                              .size = size,
                              .layers = layers,
                              .error = position_error(scene.record),
                              .pad0 = 0,
                              .pad1 = 0,
                              .pad2 = 0};
        w.traversal.careful = false;
        while (!cast(device, scene, w, maps, batch)) {
            w.traversal.careful = true;
        }
    }
    return maps;
}

void trace_cube_maps(Device& device, const DeviceScene& scene, const CubeMaps& maps,
                     const CubeSearchSettings& settings, const RayBatch& batch) {
    const float margin = box_margin * scene.record.radius;
    const glm::vec3 low = scene.box.low - margin;
    const glm::vec3 high = scene.box.high + margin;
    const CubeSearch params{.count = count_record(batch.count),
                            .centers = maps.count,
                            .layers = maps.layers,
                            .size = maps.size,
                            .steps = settings.steps,
                            .march = settings.march,
                            .exact = settings.exact ? 1u : 0u,
                            .tolerance = static_cast<float>(settings.tolerance),
                            .triangles = scene.record.triangle_count,
                            .low_x = low.x,
                            .low_y = low.y,
                            .low_z = low.z,
                            .high_x = high.x,
                            .high_y = high.y,
                            .high_z = high.z};
    dispatch(device,
             kernels::cube_trace{.cube = cube_bindings(scene, maps),
                                 .rays = batch.rays,
                                 .active_rays = batch.active,
                                 .counts = counts_or(batch.count, batch.active),
                                 .hits = batch.results,
                                 .params = params},
             batch.count);
}

} // namespace argand
