#pragma once

#include "scene/environment.hpp"

namespace argand {

/// Where the sun stands, and how hazy the air is.
struct SunPosition {
    double elevation = 45; ///< above the horizon [degrees], -90 to 90
    double azimuth = 180;  ///< clockwise from above, from -Z over +X [degrees]
    double turbidity =
        2.5; ///< vertical optical depth of air with haze over that of pure air, 1 to 10
};

/// The clear sky with its sun as seen from the ground, in cd/m². Rayleigh scattering by molecules,
/// Mie scattering and absorption by haze and absorption by ozone in a spherical atmosphere
/// (Bruneton and Neyret 2008; Bruneton 2017): light that is scattered once is integrated along each
/// ray, that which is scattered more often is approximated as in Hillaire 2020, section 5.5, for 16
/// wavelengths, which make linear sRGB. Below the horizon is ground of even albedo. The sun is a
/// disc of even radiance.
Environment sun_and_sky(const SunPosition& sun);

} // namespace argand
