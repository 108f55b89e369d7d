#pragma once

#include "imagespace/cube_centers.hpp"
#include "methods/option.hpp"

#include <cstdint>
#include <optional>

namespace argand {

/// The values of cube_map_options() in these settings.
struct CubeMapOptions {
    CenterSettings centers;
    std::uint32_t size = 128;        ///< texels along the edge of a map's face
    std::optional<MapMaking> making; ///< none: the faster one on the device
    std::uint32_t choose_every = 1;  ///< images
    CubeSearchSettings search;
    bool for_shadows = false;   ///< shadow rays go through the maps, too
    bool for_scattered = false; ///< and the rays of eye paths behind the first surface
};

CubeMapOptions cube_map_options_of(const RenderSettings& settings);

} // namespace argand
