#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace argand {

/// An equirectangular picture of the sky, +Y up. Texels lie row by row from the top (+Y); the
/// direction (x, y, z) is at u = 1/2 + atan2(z, x)/2π of the width and v = acos(y)/π of the height,
/// as three.js has it. Between the middles of texels radiance is linear in the azimuth and in the
/// cosine of the angle from +Y.
struct SkyPicture {
    int width = 0, height = 0;
    std::vector<glm::vec3> texels; ///< radiance [cd/m²], width × height, finite, not negative
    glm::dvec3 mean{0};            ///< radiance over all directions
    std::uint64_t fingerprint = 0; ///< of the size and the texels
};

/// Brightest texel of a picture [cd/m²], so that sums and powers stay finite.
inline constexpr float brightest_texel = 1e30f;

/// Throws Error, which calls the picture `name`, unless there are width × height texels, at least
/// one, which are finite, not negative and no brighter than brightest_texel.
std::shared_ptr<const SkyPicture>
make_sky_picture(int width, int height, std::vector<glm::vec3> texels, const std::string& name);

/// The same in fewer texels, the means of those that they replace. Sides are at most the picture's.
std::shared_ptr<const SkyPicture> reduced(const SkyPicture& picture, int width, int height);

/// A disc of even radiance in the sky, infinitely far away.
struct Sun {
    glm::vec3 towards{0, 1, 0};  ///< unit direction to its middle, before Environment::rotation
    float radius = 0.004652439f; ///< angle [rad], above 0 and at most 0.5
    glm::vec3 radiance{0};       ///< [cd/m²], in addition to the picture's

    bool operator==(const Sun&) const = default;
};

/// What lights a scene from outside, from all directions.
struct Environment {
    std::string name; ///< for the user: a file, "sun and sky", "studio"
    std::shared_ptr<const SkyPicture> picture;
    double rotation = 0; ///< of picture and sun about +Y [degrees]
    float strength = 1;  ///< factor of all radiance
    std::optional<Sun> sun;
};

/// Solid angle of the sun's disc [sr].
double solid_angle(const Sun& sun);

/// Mean radiance over all directions [cd/m²]: the irradiance of a sphere is π times it.
glm::dvec3 mean_radiance(const Environment& environment);

/// Irradiance of a surface that faces the sun, by the sun alone [lux].
glm::dvec3 illuminance_of_sun(const Environment& environment);

/// A direction before and after the rotation.
glm::dvec3 rotated(const Environment& environment, const glm::dvec3& direction);

/// Of all that decides the light.
std::uint64_t fingerprint(const Environment& environment);

/// Whether they light a scene alike.
inline bool operator==(const Environment& a, const Environment& b) {
    return fingerprint(a) == fingerprint(b);
}

} // namespace argand
