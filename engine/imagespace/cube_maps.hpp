#pragma once

#include "kernels/cube_bindings.hpp"
#include "world/device_scene.hpp"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace argand {

/// Cube maps of a scene's surfaces (shared/cube_map.h).
struct CubeMaps {
    Buffer texels;            ///< uvec2 per texel, map by map, the layers of a center together
    Buffer centers;           ///< vec4 each
    std::uint32_t count = 0;  ///< of centers
    std::uint32_t layers = 1; ///< around each, see layer_opaque of shared/image_space_records.h
    std::uint32_t size = 0;   ///< texels along the edge of a face
};

/// Layers that the maps of a scene need.
std::uint32_t layers_of(const DeviceScene& scene);

/// The most texels of maps that fit into a buffer of the device.
std::uint64_t max_cube_texels(const Device& device);

/// What the kernels that read cube maps bind in common
/// (shaders/comp/imagespace/cube_bindings.glsl).
kernels::CubeBindings cube_bindings(const DeviceScene& scene, const CubeMaps& maps);

/// How maps are made: drawn by the device's rasteriser, or by casting rays through the scene's
/// tree.
enum class MapMaking : std::uint8_t { raster, cast };

/// The most texels along the edge of a face that the device draws; 0 if it has no rasteriser.
std::uint32_t max_drawn_size(Device& device);

/// Makes the maps around each center. Requires centers, no more texels than max_cube_texels(), and
/// if they are drawn, a size of at most max_drawn_size(). If they are cast, waits for the device.
CubeMaps make_cube_maps(Device& device, const DeviceScene& scene,
                        std::span<const glm::vec3> centers, std::uint32_t size,
                        std::uint32_t layers, MapMaking making);

/// How rays find their hits in cube maps.
struct CubeSearchSettings {
    std::uint32_t steps = 5; ///< iterations of the root finder
    /// Directions in which a ray is looked at before; 0: the iteration begins as published.
    std::uint32_t march = 32;
    bool exact = true;        ///< hits are those of the texels' triangles; else texels are points
    double tolerance = 0.001; ///< ε of Yao et al. 2010, equation 2, where texels are points
};

/// Finds hits as trace_closest() does, but in cube maps. u of those without one tells why
/// (ray_escaped, ray_lost). batch.results must hold the hits that the rays leave; no_triangle where
/// there is none, and start_of_path as t where they start anywhere on a triangle. Records only.
void trace_cube_maps(Device& device, const DeviceScene& scene, const CubeMaps& maps,
                     const CubeSearchSettings& settings, const RayBatch& batch);

/// Finds how much light passes what the maps show on the way of shadow rays; results: uint, its
/// thickness (shared/alpha.h). Of rays that end at one of the first `at_lights` centers, the maps
/// around it are shadow maps with percentage-closer filtering (Yao et al. 2010, section 7); others
/// are searched for as those of trace_cube_maps(), and what no map shows is lit. hits: HitRecord,
/// where the rays start. Records only.
void trace_cube_shadows(Device& device, const DeviceScene& scene, const CubeMaps& maps,
                        std::size_t at_lights, const CubeSearchSettings& settings,
                        const Buffer& hits, const RayBatch& batch);

} // namespace argand
