#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace argand {

/// Values at the wavelengths of the model.
inline constexpr std::size_t wavelengths = 16;
using Spectrum = std::array<double, wavelengths>;

/// Columns of molecules [m at sea level], haze [m at sea level] and ozone [m at its densest].
struct Columns {
    double molecules = 0, haze = 0, ozone = 0;
};

/// The Earth's atmosphere as a spherical shell in which density depends on the height alone.
class Atmosphere {
public:
    explicit Atmosphere(double turbidity);

    static constexpr double ground = 6360e3, top = 6460e3; ///< radii [m]

    /// Share of light that reaches the edge of the atmosphere from radius r in a direction whose
    /// cosine to the zenith is mu; 0 where the Earth is in the way.
    Spectrum transmittance(double r, double mu) const;
    /// The same past these columns.
    Spectrum transmittance(const Columns& columns) const;

    /// Radiance [W/m²/sr/nm] that arrives at radius r from a direction with cosine mu to the
    /// zenith, where the sun has cosine mu_s to the zenith and nu to the direction. The ray must
    /// not meet the Earth.
    Spectrum radiance(double r, double mu, double mu_s, double nu) const;

    /// Irradiance of the sun outside the atmosphere [W/m²/nm].
    static Spectrum of_sun();

private:
    struct Air {
        Spectrum scattering_by_molecules, scattering_by_haze, extinction;
    };
    Air air_at(double height) const;
    Columns columns_to_top(double r, double mu) const;
    Spectrum scattered_often(double r, double mu_s) const;
    Spectrum often_scattered_at(double r, double mu_s) const;
    void fill_columns();
    void fill_scattered_often();

    Spectrum molecules_{}, haze_{}, ozone_{}; ///< extinction [1/m] where they are densest
    std::vector<Columns> columns_;            ///< table over the mapping of Bruneton 2017
    std::vector<Spectrum> often_;             ///< isotropic radiance over height and mu_s
};

/// Linear sRGB [cd/m²] of a spectral radiance [W/m²/sr/nm], or lux of an irradiance.
glm::dvec3 color_of(const Spectrum& spectrum);

} // namespace argand
