#pragma once

#include "imagespace/cube_maps.hpp"
#include "kernels/alpha_bindings.hpp"

namespace argand {

/// Fills the texels of maps, of which all else is there, by casting rays. Waits for the device.
void cast_cube_maps(Device& device, const DeviceScene& scene, const CubeMaps& maps);

/// Fills them by the device's rasteriser. Records only.
void draw_cube_maps(Device& device, const DeviceScene& scene, const CubeMaps& maps);

/// What kernels bind that look up alpha, and their constants.
kernels::AlphaBindings alpha_bindings(const DeviceScene& scene);
kernels::AlphaConstants alpha_constants(const DeviceScene& scene);

inline constexpr std::uint32_t cube_faces = 6;

} // namespace argand
