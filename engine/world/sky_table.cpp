#include "world/sky_table.hpp"

#include "base/error.hpp"
#include "shared/lights.h"
#include "shared/sky.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

namespace argand {

namespace {

using std::numbers::pi;
/// Share of the samples that rows and cells get whatever their brightness.
constexpr double even_share = 0.05;

/// The kernels' text, to look at a table.
struct SkyOnHost {
    const uint* sky;
#include "shared/kernels/sky.h"
};

double brightness_of(const Sun& sun) { return sky_brightness(sun.radiance); }

/// Divides sky_digits among ranges in proportion to their weights: at least one for each weight
/// above 0. Weights sum to 1, or are all 0. Writes their starts, `stride` words apart.
void write_starts(std::span<const double> weights, std::uint32_t* words, std::size_t stride) {
    const auto count =
        std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0; });
    const double to_divide = double(sky_digits) - static_cast<double>(count);
    double before = 0;
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        words[i * stride] = static_cast<std::uint32_t>(
            std::min(std::floor(std::min(before, 1.0) * to_divide) + static_cast<double>(seen),
                     double(sky_digits)));
        before += weights[i];
        seen += weights[i] > 0 ? 1 : 0;
    }
}

/// Weights that sum to 1: mostly in proportion to `shares`, but for a part in proportion to `even`
/// where a share is above 0.
std::vector<double> mixed(std::span<const double> shares, std::span<const double> even) {
    double all = 0, all_even = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        all += shares[i];
        all_even += shares[i] > 0 ? even[i] : 0;
    }
    std::vector<double> weights(shares.size(), 0.0);
    for (std::size_t i = 0; i < shares.size() && all > 0; ++i) {
        weights[i] = shares[i] > 0
                         ? (1 - even_share) * shares[i] / all + even_share * even[i] / all_even
                         : 0;
    }
    return weights;
}

/// sin² and cos² of half the angle from +Y of a row's upper border.
glm::dvec2 border(int row, int height) {
    if (row == 0 || row > height) {
        return row == 0 ? glm::dvec2(0, 1) : glm::dvec2(1, 0);
    }
    const double half = 0.5 * pi * (row - 0.5) / height;
    return {std::sin(half) * std::sin(half), std::cos(half) * std::cos(half)};
}

std::uint32_t bits_of(double x) { return std::bit_cast<std::uint32_t>(static_cast<float>(x)); }

void write_header(const Environment& environment, double mean_of_picture, SkyTable& table) {
    std::vector<std::uint32_t>& words = table.words;
    words[sky_width] = static_cast<std::uint32_t>(table.width);
    words[sky_height] = static_cast<std::uint32_t>(table.height);
    const double angle = environment.rotation * pi / 180;
    words[sky_turn] = bits_of(std::cos(angle));
    words[sky_turn + 1] = bits_of(std::sin(angle));
    if (!environment.sun || !(brightness_of(*environment.sun) > 0)) {
        return;
    }
    const Sun& sun = *environment.sun;
    for (std::uint32_t c = 0; c < 3; ++c) {
        const int component = static_cast<int>(c);
        words[sun_towards + c] = bits_of(sun.towards[component]);
        words[sun_radiance + c] = bits_of(double(sun.radiance[component]) * environment.strength);
    }
    const double half = std::sin(0.5 * double(sun.radius));
    const double sine = std::sin(double(sun.radius));
    words[sun_height] = bits_of(2 * half * half);
    words[sun_sine2] = bits_of(sine * sine);
    // Half in proportion to power, half to either, as plain_shares() chooses among lights.
    const double power = brightness_of(sun) * solid_angle(sun);
    const double of_picture = mean_of_picture * 4 * pi;
    words[sun_probability] =
        of_picture > 0 ? bits_of(0.25 + 0.5 * power / (power + of_picture)) : bits_of(1);
}

/// Packs the texels, which cells then read as kernels do.
void write_texels(const SkyPicture& picture, float strength, std::uint32_t* words) {
    for (const glm::vec3& texel : picture.texels) {
        const glm::uvec2 packed = packed_radiance(texel * strength);
        *words++ = packed.x;
        *words++ = packed.y;
    }
}

void write_cells(SkyTable& table) {
    SkyOnHost on_host{table.words.data()};
    const int rows = table.height + 1;
    std::vector<double> of_rows, solid_angles;
    std::vector<double> cells(static_cast<std::size_t>(table.width));
    const std::vector<double> alike(cells.size(), 1.0);
    for (int row = 0; row < rows; ++row) {
        SkyCell cell{static_cast<uint>(row), 0, 0, 0};
        for (double& brightness : cells) {
            brightness = brightness_of_cell(on_host.corners_of_cell(cell));
            ++cell.column;
        }
        const double share = border(row + 1, table.height).x - border(row, table.height).x;
        solid_angles.push_back(share);
        of_rows.push_back(share * std::accumulate(cells.begin(), cells.end(), 0.0));
        write_starts(mixed(cells, alike),
                     &table.words[on_host.cells_of_sky(static_cast<uint>(row))], 1);
    }
    write_starts(mixed(of_rows, solid_angles), &table.words[sky_row_0], sky_row_words);
    table.words[on_host.row_of_sky(static_cast<uint>(rows))] = sky_digits;
    for (int row = 0; row <= rows; ++row) {
        std::uint32_t* words = &table.words[on_host.row_of_sky(static_cast<uint>(row))];
        const glm::dvec2 upper = border(row, table.height);
        words[2] = bits_of(upper.x);
        words[3] = bits_of(upper.y);
        if (row < rows) {
            const double probability = (words[sky_row_words] - words[0]) / double(sky_digits);
            words[1] = bits_of(probability * table.width /
                               (4 * pi * solid_angles[static_cast<std::size_t>(row)]));
        }
    }
}

} // namespace

glm::uvec2 packed_radiance(const glm::vec3& radiance) {
    constexpr int mantissa = 18, bias = 127, least = 1; // the power of a normal number
    const float largest = std::max({radiance.r, radiance.g, radiance.b});
    int exponent = 0;
    std::frexp(largest, &exponent);
    if (std::round(std::ldexp(double(largest), mantissa - exponent)) >= double(1 << mantissa)) {
        ++exponent;
    }
    const int power = std::max(exponent - mantissa + bias, least);
    std::array<std::uint32_t, 3> m{};
    for (std::size_t c = 0; c < m.size(); ++c) {
        m[c] = static_cast<std::uint32_t>(
            std::lround(std::ldexp(double(radiance[static_cast<int>(c)]), bias - power)));
    }
    return {m[0] | m[1] << 18u,
            m[1] >> 14u | m[2] << 4u | static_cast<std::uint32_t>(power) << 22u};
}

std::uint64_t words_of_sky(int width, int height) {
    const auto columns = static_cast<std::uint64_t>(width);
    const auto rows = static_cast<std::uint64_t>(height);
    return sky_row_0 + sky_row_words * (rows + 2) + columns * (rows + 1) +
           sky_texel_words * columns * rows;
}

SkyTable make_sky_table(const Environment& environment, std::uint64_t most_words) {
    SkyTable table;
    const std::shared_ptr<const SkyPicture>& whole = environment.picture;
    table.width = whole ? whole->width : 1;
    table.height = whole ? whole->height : 1;
    while (words_of_sky(table.width, table.height) > most_words &&
           (table.width > 1 || table.height > 1)) {
        table.width = std::max(table.width / 2, 1);
        table.height = std::max(table.height / 2, 1);
        ++table.halvings;
    }
    table.words.resize(words_of_sky(table.width, table.height));
    write_header(environment, whole ? sky_brightness(glm::vec3(whole->mean)) : 0, table);
    if (whole) {
        const std::shared_ptr<const SkyPicture> picture =
            table.halvings > 0 ? reduced(*whole, table.width, table.height) : whole;
        SkyOnHost on_host{table.words.data()};
        write_texels(*picture, environment.strength,
                     &table.words[on_host.cells_of_sky(static_cast<uint>(table.height) + 1)]);
    }
    write_cells(table);
    return table;
}

glm::dvec2 numbers_of_direction(const SkyTable& table, const glm::vec3& towards) {
    SkyOnHost on_host{table.words.data()};
    const vec3 d = to_picture(towards, on_host.sky_float2(sky_turn));
    const Cone sun = on_host.cone_of_sun();
    const double of_sun = on_host.sky_float(sun_probability);
    if (of_sun > 0 && is_in_cone(sun, d)) {
        const vec3 local = to_local(make_frame(sun.axis), d);
        const double below = 0.5 * (double(local.x) * local.x + double(local.y) * local.y);
        const double turn = turn_of(local.y, local.x);
        return {of_sun * std::min(below / sun.height, 1.0), turn - std::floor(turn)};
    }
    const SkyCell cell = on_host.cell_of_sky(d);
    const SkyCorners corners = on_host.corners_of_cell(cell);
    const vec2 rows = brightness_of_rows(corners);
    const vec2 sides = brightness_of_sides(corners, cell.y);
    const auto in_range = [](double first, double count, double share) {
        return (first + count * share) / double(sky_digits);
    };
    const std::uint32_t* row = &table.words[on_host.row_of_sky(cell.row)];
    const double y =
        in_range(row[0], row[sky_row_words] - row[0], number_of_linear(rows.x, rows.y, cell.y));
    const double x = in_range(table.words[on_host.cells_of_sky(cell.row) + cell.column],
                              on_host.digits_of_cell(cell.row, cell.column),
                              number_of_linear(sides.x, sides.y, cell.x));
    return {of_sun + (1 - of_sun) * x, y};
}

} // namespace argand
