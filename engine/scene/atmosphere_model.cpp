#include "scene/atmosphere_model.hpp"

#include "base/thread_each.hpp"
#include "scene/direction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace argand {

namespace {

using std::numbers::pi;

constexpr double first_wavelength = 380, wavelength_step = 25; // nm

// Scale heights [m], the share of haze's extinction that scatters, the asymmetry of its phase
// function: Bruneton and Neyret 2008, section 4. Ozone: Bruneton 2017.
constexpr double height_of_molecules = 8000, height_of_haze = 1200;
constexpr double scattered_by_haze = 0.9, asymmetry = 0.8;
constexpr double middle_of_ozone = 25e3, half_of_ozone = 15e3; // m
constexpr double ozone_at_middle = 300 * 2.687e20 / 15e3;      // molecules per m³ for 300 DU
constexpr double albedo_of_ground = 0.2;
constexpr double angstrom = 1.3; // power of the wavelength in haze's extinction (Ångström 1929)

constexpr int heights = 64, angles = 256;            // of the table of columns
constexpr int often_heights = 12, often_angles = 32; // of the table of light scattered often
constexpr int steps_of_columns = 64, steps_of_rays = 32, steps_of_sphere = 16;

double wavelength(std::size_t i) { return first_wavelength + wavelength_step * double(i); }

/// Irradiance of the sun outside the atmosphere [W/m²/nm], at 380, 405, ... 755 nm: ASTM E490.
constexpr Spectrum solar = {1.0125, 1.7291, 1.6125, 2.0276, 1.9338, 1.8733, 1.8931, 1.8423,
                            1.8147, 1.7249, 1.6465, 1.5388, 1.4740, 1.3890, 1.3143, 1.2521};

/// Cross-section of ozone [10^-25 m²] at the same wavelengths: Serdyuchenko et al. 2014.
constexpr Spectrum ozone_cross_section = {0.0028, 0.0215, 0.0845, 0.2993, 0.7752, 1.5410,
                                          2.7550, 3.8830, 4.3980, 4.6620, 3.2150, 2.0450,
                                          1.2090, 0.7011, 0.4150, 0.2844};

double sum_of(const Spectrum& a, double (*weight)(double)) {
    double sum = 0;
    for (std::size_t i = 0; i < wavelengths; ++i) {
        sum += a[i] * weight(wavelength(i));
    }
    return sum * wavelength_step;
}

// The CIE 1931 colour matching functions as Wyman, Sloan and Shirley 2013 fit them.
double lobe(double x, double middle, double left, double right) {
    const double t = (x - middle) / (x < middle ? left : right);
    return std::exp(-0.5 * t * t);
}
double x_bar(double l) {
    return 1.056 * lobe(l, 599.8, 37.9, 31.0) + 0.362 * lobe(l, 442.0, 16.0, 26.7) -
           0.065 * lobe(l, 501.1, 20.4, 26.2);
}
double y_bar(double l) {
    return 0.821 * lobe(l, 568.8, 46.9, 40.5) + 0.286 * lobe(l, 530.9, 16.3, 31.1);
}
double z_bar(double l) {
    return 1.217 * lobe(l, 437.0, 11.8, 36.0) + 0.681 * lobe(l, 459.0, 26.0, 13.8);
}

double phase_of_molecules(double nu) { return 3 / (16 * pi) * (1 + nu * nu); }

/// Cornette and Shanks 1992.
double phase_of_haze(double nu) {
    constexpr double g = asymmetry;
    return 3 / (8 * pi) * (1 - g * g) * (1 + nu * nu) /
           ((2 + g * g) * std::pow(1 + g * g - 2 * g * nu, 1.5));
}

/// Distance along a ray from radius r to a sphere around the Earth's middle that contains r.
double distance_to(double sphere, double r, double mu) {
    return -r * mu + std::sqrt(std::max(r * r * (mu * mu - 1) + sphere * sphere, 0.0));
}

bool meets_ground(double r, double mu) {
    return mu < 0 && r * r * (mu * mu - 1) + Atmosphere::ground * Atmosphere::ground >= 0;
}

double distance_to_ground(double r, double mu) {
    return -r * mu - std::sqrt(std::max(
                         r * r * (mu * mu - 1) + Atmosphere::ground * Atmosphere::ground, 0.0));
}

struct Densities {
    double molecules, haze, ozone; ///< over those where they are densest
};
Densities densities_at(double height) {
    return {std::exp(-height / height_of_molecules), std::exp(-height / height_of_haze),
            std::max(1 - std::abs(height - middle_of_ozone) / half_of_ozone, 0.0)};
}

/// Radius and cosine to the zenith after a distance along a ray.
struct Place {
    double r, mu;
};
Place after(double r, double mu, double t) {
    const double there = std::sqrt(std::max(t * t + 2 * r * mu * t + r * r, 0.0));
    return {std::clamp(there, Atmosphere::ground, Atmosphere::top), (r * mu + t) / there};
}

constexpr double longest_tangent() {
    return 1132430.0; // sqrt(top² - ground²)
}

/// Bilinear interpolation in a table of rows; x, y in [0, 1].
template <class T, class Mix>
T looked_up(const std::vector<T>& table, int width, int height, double x, double y, Mix mix) {
    const double across = std::clamp(x, 0.0, 1.0) * (width - 1);
    const double down = std::clamp(y, 0.0, 1.0) * (height - 1);
    const int i = std::min(static_cast<int>(across), std::max(width - 2, 0));
    const int j = std::min(static_cast<int>(down), std::max(height - 2, 0));
    const auto at = [&](int column, int row) -> const T& {
        return table[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(column)];
    };
    return mix(mix(at(i, j), at(i + 1, j), across - i),
               mix(at(i, j + 1), at(i + 1, j + 1), across - i), down - j);
}

Columns mixed_columns(const Columns& a, const Columns& b, double t) {
    return {std::lerp(a.molecules, b.molecules, t), std::lerp(a.haze, b.haze, t),
            std::lerp(a.ozone, b.ozone, t)};
}

Spectrum mixed_spectra(const Spectrum& a, const Spectrum& b, double t) {
    Spectrum result{};
    for (std::size_t i = 0; i < wavelengths; ++i) {
        result[i] = std::lerp(a[i], b[i], t);
    }
    return result;
}

} // namespace

Atmosphere::Atmosphere(double turbidity) {
    for (std::size_t i = 0; i < wavelengths; ++i) {
        const double micrometres = wavelength(i) * 1e-3;
        molecules_[i] = 1.24062e-6 / std::pow(micrometres, 4); // Bruneton and Neyret 2008
        ozone_[i] = ozone_cross_section[i] * 1e-25 * ozone_at_middle;
    }
    // Turbidity compares optical depths at 550 nm.
    const double of_air = 1.24062e-6 / std::pow(0.55, 4) * height_of_molecules;
    for (std::size_t i = 0; i < wavelengths; ++i) {
        haze_[i] =
            (turbidity - 1) * of_air / height_of_haze * std::pow(wavelength(i) / 550, -angstrom);
    }
    fill_columns();
    fill_scattered_often();
}

Spectrum Atmosphere::of_sun() { return solar; }

// Rows are radii, as the length of the tangent to the ground; columns are directions above the
// horizon, as the distance to the edge of the atmosphere (Bruneton 2017, "Transmittance").
void Atmosphere::fill_columns() {
    columns_.reserve(std::size_t(heights) * angles);
    for (int row = 0; row < heights; ++row) {
        const double tangent = longest_tangent() * row / (heights - 1);
        const double r = std::sqrt(tangent * tangent + ground * ground);
        const double nearest = top - r, farthest = tangent + longest_tangent();
        for (int column = 0; column < angles; ++column) {
            const double distance = nearest + (farthest - nearest) * column / (angles - 1);
            const double mu =
                distance > 0
                    ? std::clamp((top * top - r * r - distance * distance) / (2 * r * distance),
                                 -1.0, 1.0)
                    : 1;
            Columns sum;
            for (int i = 0; i < steps_of_columns; ++i) {
                // Steps grow with the square: most of the air is near.
                const double from = double(i) / steps_of_columns;
                const double to = (i + 1.0) / steps_of_columns;
                const double step = distance * (to * to - from * from);
                const Place there = after(r, mu, distance * 0.5 * (to * to + from * from));
                const Densities d = densities_at(there.r - ground);
                sum.molecules += d.molecules * step;
                sum.haze += d.haze * step;
                sum.ozone += d.ozone * step;
            }
            columns_.push_back(sum);
        }
    }
}

Columns Atmosphere::columns_to_top(double r, double mu) const {
    const double tangent = std::sqrt(std::max(r * r - ground * ground, 0.0));
    const double nearest = top - r, farthest = tangent + longest_tangent();
    const double share = (distance_to(top, r, mu) - nearest) / (farthest - nearest);
    return looked_up(columns_, angles, heights, share, tangent / longest_tangent(), mixed_columns);
}

Spectrum Atmosphere::transmittance(const Columns& columns) const {
    Spectrum result{};
    for (std::size_t i = 0; i < wavelengths; ++i) {
        result[i] = std::exp(-molecules_[i] * columns.molecules - haze_[i] * columns.haze -
                             ozone_[i] * columns.ozone);
    }
    return result;
}

Spectrum Atmosphere::transmittance(double r, double mu) const {
    return meets_ground(r, mu) ? Spectrum{} : transmittance(columns_to_top(r, mu));
}

Atmosphere::Air Atmosphere::air_at(double height) const {
    const Densities d = densities_at(height);
    Air air{};
    for (std::size_t i = 0; i < wavelengths; ++i) {
        air.scattering_by_molecules[i] = molecules_[i] * d.molecules;
        air.scattering_by_haze[i] = haze_[i] * scattered_by_haze * d.haze;
        air.extinction[i] = molecules_[i] * d.molecules + haze_[i] * d.haze + ozone_[i] * d.ozone;
    }
    return air;
}

// Hillaire 2020, section 5.5: light that has been scattered twice, evenly over directions, and its
// share that is scattered there again, as a geometric series. Phase functions are even.
Spectrum Atmosphere::often_scattered_at(double r, double mu_s) const {
    constexpr int directions = 64;
    const double sine_s = std::sqrt(std::max(1 - mu_s * mu_s, 0.0));
    Spectrum second{}, again{};
    for (int k = 0; k < directions; ++k) {
        const glm::dvec3 d = spiral_direction(k, directions);
        const bool ends = meets_ground(r, d.z);
        const double distance = ends ? distance_to_ground(r, d.z) : distance_to(top, r, d.z);
        const double nu = d.x * sine_s + d.z * mu_s;
        Spectrum left;
        left.fill(1);
        for (int i = 0; i < steps_of_sphere; ++i) {
            const double from = double(i) / steps_of_sphere;
            const double to = (i + 1.0) / steps_of_sphere;
            const double step = distance * (to * to - from * from);
            const double t = distance * 0.5 * (to * to + from * from);
            const Place there = after(r, d.z, t);
            const Air air = air_at(there.r - ground);
            const Spectrum of_sun = transmittance(there.r, (r * mu_s + t * nu) / there.r);
            for (std::size_t w = 0; w < wavelengths; ++w) {
                const double scattered = air.scattering_by_molecules[w] + air.scattering_by_haze[w];
                const double passed = std::exp(-air.extinction[w] * step);
                const double collected =
                    air.extinction[w] > 0 ? left[w] * (1 - passed) / air.extinction[w] : 0;
                second[w] += collected * scattered * of_sun[w] / (4 * pi) / directions;
                again[w] += collected * scattered / directions;
                left[w] *= passed;
            }
        }
        if (ends) {
            const Place there = after(r, d.z, distance);
            const double height_of_sun = (r * mu_s + distance * nu) / there.r;
            const Spectrum of_sun = transmittance(ground, height_of_sun);
            for (std::size_t w = 0; w < wavelengths; ++w) {
                second[w] += left[w] * of_sun[w] * std::max(height_of_sun, 0.0) * albedo_of_ground /
                             pi / directions;
            }
        }
    }
    for (std::size_t w = 0; w < wavelengths; ++w) {
        second[w] *= solar[w] / (1 - again[w]);
    }
    return second;
}

void Atmosphere::fill_scattered_often() {
    often_.resize(std::size_t(often_heights) * often_angles);
    for_each_on_all_cores(often_.size(), [&](std::size_t i) {
        const std::size_t height = i / often_angles, angle = i % often_angles;
        const double share = double(height) / (often_heights - 1);
        const double mu_s = 2.0 * double(angle) / (often_angles - 1) - 1;
        often_[i] = often_scattered_at(ground + share * share * (top - ground), mu_s);
    });
}

Spectrum Atmosphere::scattered_often(double r, double mu_s) const {
    return looked_up(often_, often_angles, often_heights, 0.5 + 0.5 * mu_s,
                     std::sqrt(std::max(r - ground, 0.0) / (top - ground)), mixed_spectra);
}

Spectrum Atmosphere::radiance(double r, double mu, double mu_s, double nu) const {
    const double distance = distance_to(top, r, mu);
    const double of_molecules = phase_of_molecules(nu), of_haze = phase_of_haze(nu);
    Spectrum result{};
    Spectrum left;
    left.fill(1);
    for (int i = 0; i < steps_of_rays; ++i) {
        const double from = double(i) / steps_of_rays;
        const double to = (i + 1.0) / steps_of_rays;
        const double step = distance * (to * to - from * from);
        const double t = distance * 0.5 * (to * to + from * from);
        const Place there = after(r, mu, t);
        const double mu_there = std::clamp((r * mu_s + t * nu) / there.r, -1.0, 1.0);
        const Air air = air_at(there.r - ground);
        const Spectrum of_sun = transmittance(there.r, mu_there);
        const Spectrum often = scattered_often(there.r, mu_there);
        for (std::size_t w = 0; w < wavelengths; ++w) {
            const double molecules = air.scattering_by_molecules[w];
            const double haze = air.scattering_by_haze[w];
            const double source =
                (molecules * of_molecules + haze * of_haze) * of_sun[w] * solar[w] +
                (molecules + haze) * often[w];
            const double passed = std::exp(-air.extinction[w] * step);
            const double collected =
                air.extinction[w] > 0 ? left[w] * (1 - passed) / air.extinction[w] : 0;
            result[w] += collected * source;
            left[w] *= passed;
        }
    }
    return result;
}

glm::dvec3 color_of(const Spectrum& spectrum) {
    constexpr double lumens_per_watt = 683;
    const double x = lumens_per_watt * sum_of(spectrum, x_bar);
    const double y = lumens_per_watt * sum_of(spectrum, y_bar);
    const double z = lumens_per_watt * sum_of(spectrum, z_bar);
    return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
            -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
            0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

} // namespace argand
