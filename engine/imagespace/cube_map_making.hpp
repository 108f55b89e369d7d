#pragma once

#include "imagespace/cube_maps.hpp"

namespace argand {

/// Fills the texels of maps, of which all else is there, by casting rays. Waits for the device.
void cast_cube_maps(Device& device, const DeviceScene& scene, const CubeMaps& maps);

/// Fills them by the device's rasteriser. Records only.
void draw_cube_maps(Device& device, const DeviceScene& scene, const CubeMaps& maps);

inline constexpr std::uint32_t cube_faces = 6;

} // namespace argand
