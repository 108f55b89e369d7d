#include "imagespace/cube_maps.hpp"

#include "imagespace/cube_map_making.hpp"
#include "kernels/cube_shadow.hpp"
#include "kernels/cube_trace.hpp"
#include "parallel/parts.hpp"
#include "shared/bsdf.h"
#include "shared/cube_map.h"
#include "shared/image_space_records.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace argand {

namespace {

// Rays are looked at in the scene's box and so far around it, in its radii: behind a wall on its
// edge.
constexpr float box_margin = 0.005f;

CubeSearch search_record(const DeviceScene& scene, const CubeMaps& maps,
                         const CubeSearchSettings& settings, const Count& rays) {
    const float margin = box_margin * scene.record.radius;
    const glm::vec3 low = scene.box.low - margin;
    const glm::vec3 high = scene.box.high + margin;
    return {.count = count_record(rays),
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
    return {.map_texels = maps.texels,
            .centers = maps.centers,
            .positions = scene.positions,
            .triangles = scene.triangles};
}

kernels::AlphaBindings alpha_bindings(const DeviceScene& scene) {
    return {.scene = scene.scene,
            .corners = scene.triangles,
            .materials = scene.materials,
            .attributes = scene.attributes,
            .textures = scene.textures,
            .texels = scene.texels};
}

kernels::AlphaConstants alpha_constants(const DeviceScene& scene) {
    const kernels::TextureConstants textures = scene.texture_constants();
    return {.textured = textures.textured, .vertex_colors = textures.vertex_colors};
}

std::uint32_t max_drawn_size(Device& device) {
    const Limits& limits = device.info().limits;
    return device.raster() && limits.layers >= cube_faces ? limits.image : 0;
}

CubeMaps make_cube_maps(Device& device, const DeviceScene& scene,
                        std::span<const glm::vec3> centers, std::uint32_t size,
                        std::uint32_t layers, MapMaking making) {
    std::vector<glm::vec4> places;
    for (const glm::vec3& center : centers) {
        places.emplace_back(center, 0);
    }
    CubeMaps maps{.texels = device.allocate("cube maps", centers.size() * cube_texels(size) *
                                                             layers * sizeof(glm::uvec2)),
                  .centers = upload(device, "centers of cube maps", places),
                  .count = static_cast<std::uint32_t>(centers.size()),
                  .layers = layers,
                  .size = size};
    if (making == MapMaking::raster) {
        draw_cube_maps(device, scene, maps);
    } else {
        cast_cube_maps(device, scene, maps);
    }
    return maps;
}

void trace_cube_maps(Device& device, const DeviceScene& scene, const CubeMaps& maps,
                     const CubeSearchSettings& settings, const RayBatch& batch) {
    dispatch(device,
             kernels::cube_trace{.cube = cube_bindings(scene, maps),
                                 .rays = batch.rays,
                                 .active_rays = batch.active,
                                 .counts = counts_or(batch.count, batch.active),
                                 .hits = batch.results,
                                 .params = search_record(scene, maps, settings, batch.count)},
             batch.count);
}

void trace_cube_shadows(Device& device, const DeviceScene& scene, const CubeMaps& maps,
                        std::size_t at_lights, const CubeSearchSettings& settings,
                        const Buffer& hits, const RayBatch& batch) {
    CubeSearch params = search_record(scene, maps, settings, batch.count);
    params.at_lights = static_cast<std::uint32_t>(at_lights);
    dispatch(device,
             kernels::cube_shadow{.cube = cube_bindings(scene, maps),
                                  .rays = batch.rays,
                                  .active_rays = batch.active,
                                  .counts = counts_or(batch.count, batch.active),
                                  .hits = hits,
                                  .occluded = batch.results,
                                  .alpha = alpha_bindings(scene),
                                  .params = params,
                                  .constants = {.has_alpha = scene.plan.needs(Feature::alpha),
                                                .alpha = alpha_constants(scene)}},
             batch.count);
}

} // namespace argand
