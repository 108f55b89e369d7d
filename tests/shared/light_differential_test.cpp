// Differentials of emitted photons, compared with finite differences of light_emit in double
// precision.
#define ARGAND_REAL_DOUBLE
#include "differential_case.hpp"
#include "stretch.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace argand::oracle {
namespace {

using paths::Start;

const double n = paths::photon_count;

/// Result of light_emit for these random numbers.
EmittedPhoton emitted(const LightRecord& l, vec4 u, vec4 v) {
    EmittedPhoton p;
    light_emit(l, all_light_kinds, {vec3(0), 2.0}, u, v, p);
    return p;
}

/// Whether the numbers are away from the samplers' seams.
bool smooth_there(vec4 u) {
    const double a = std::abs(2 * u.z - 1);
    const double b = std::abs(2 * u.w - 1);
    const double c = std::abs(2 * u.x - 1);
    const double d = std::abs(2 * u.y - 1);
    return std::abs(a - b) > 1e-3 && std::abs(c - d) > 1e-3 &&
           std::min({u.x, u.y, u.z, u.w}) > 1e-3 && std::max({u.x, u.y, u.z, u.w}) < 1 - 1e-3 &&
           std::max(a, b) > 1e-3 && std::max(c, d) > 1e-3;
}

TEST(Emission, SpacingMatchesTheSamplers) {
    int compared = 0;
    for (uint seed = 0; seed < 500; ++seed) {
        const vec4 u(random4(51, seed, 0, 0));
        const vec4 v(random4(51, seed, 0, 1));
        if (!smooth_there(u)) {
            continue;
        }
        ++compared;
        for (const Start start : {Start::point, Start::directional, Start::triangle, Start::sky}) {
            const LightRecord l = paths::some_light(start, seed);
            const EmittedPhoton e = emitted(l, u, v);
            const PhotonDifferential d = light_differential(l, all_light_kinds, e, 2.0, n, n);
            const double over_directions = stretch(
                [&](vec2 x) { return emitted(l, vec4(x.x, x.y, u.z, u.w), v).direction; }, vec2(u));
            const double over_positions =
                stretch([&](vec2 x) { return emitted(l, vec4(u.x, u.y, x.x, x.y), v).origin; },
                        vec2(u.z, u.w));
            double positions = over_positions / n;
            double directions = over_directions / n;
            if (start == Start::triangle) {
                // Photons choose a side, and their beam leaves it at an angle.
                positions *= light_sides(l) * dot3(e.direction, e.normal);
                directions *= light_sides(l);
            }
            if (start == Start::sky) {
                directions /=
                    4; // share of the spread that directions get: docs/methods/footprints.md
            }
            EXPECT_NEAR(area_of(d.dp_du, d.dp_dv), positions, 1e-5 * positions)
                << "start " << int(start) << ", seed " << seed;
            EXPECT_NEAR(area_of(d.dd_du, d.dd_dv), directions, 1e-5 * directions)
                << "start " << int(start) << ", seed " << seed;
        }
    }
    EXPECT_GT(compared, 400);
}

// Eq. 8: both axes of the point light, beyond their area.
TEST(Emission, PointLightFollowsThePaper) {
    const LightRecord l = paths::some_light(Start::point, 1);
    for (uint seed = 0; seed < 200; ++seed) {
        const vec4 u(random4(52, seed, 0, 0));
        const double cosine = 1 - 2 * u.y;
        const double sine = std::sqrt(1 - cosine * cosine);
        const double phi = 2 * PI * u.x;
        const EmittedPhoton e = emitted(l, u, vec4(0));
        const PhotonDifferential d = light_differential(l, all_light_kinds, e, 2.0, n, n);
        const double spacing = 2 * std::sqrt(PI / n);
        const vec3 along(-std::cos(phi) * cosine, -std::sin(phi) * cosine, sine);
        const vec3 around(-std::sin(phi), std::cos(phi), 0);
        EXPECT_NEAR(glm::length(d.dd_du - spacing * along), 0, 1e-9);
        EXPECT_NEAR(glm::length(d.dd_dv - spacing * around), 0, 1e-9);
        EXPECT_EQ(d.dp_du, vec3(0));
        EXPECT_EQ(d.dp_dv, vec3(0));
    }
}

// On the ramp of a spot's falloff, the largest of three numbers decides; its density is 3 m².
TEST(Emission, SpotsFollowTheirFalloff) {
    const LightRecord l = paths::some_light(Start::spot, 3);
    double ramp, ramp_share;
    const double all = spot_solid_angles(l.cos_inner, l.cos_outer, ramp, ramp_share);
    for (uint seed = 0; seed < 200; ++seed) {
        const vec4 r(random4(53, seed, 0, 0));
        const double m = 0.05 + 0.9 * r.z;
        const double around = 0.05 + 0.9 * r.y;
        for (const bool on_ramp : {false, true}) {
            const auto photon = [&](vec2 x) {
                return emitted(l, vec4(on_ramp ? 0 : 0.999999, x.y, x.x, 0), vec4(0));
            };
            const auto direction = [&](vec2 x) { return photon(x).direction; };
            const double density = on_ramp ? 3 * m * m * ramp / all : 1 - ramp / all;
            const double expected = stretch(direction, vec2(m, around)) / density / n;
            const PhotonDifferential d =
                light_differential(l, all_light_kinds, photon(vec2(m, around)), 2.0, n, n);
            EXPECT_NEAR(area_of(d.dd_du, d.dd_dv), expected, 1e-5 * expected)
                << "on the ramp " << on_ramp << ", m " << m;
        }
    }
}

/// Mean, over the photons that reach a patch of z = 0 around the origin, of the area of their
/// parallelogram, times the photons per area. For footprints, whose semi-axes are the
/// differentials, the same times pi.
double area_times_density(const LightRecord& l, double half_width, uint photons) {
    const double radius = 2;
    double sum = 0;
    for (uint i = 0; i < photons; ++i) {
        EmittedPhoton p;
        light_emit(l, all_light_kinds, {vec3(0), radius}, vec4(random4(57, i, 0, 0)),
                   vec4(random4(57, i, 0, 1)), p);
        const double t = -p.origin.z / p.direction.z;
        const vec3 hit = p.origin + t * p.direction;
        if (!(t > 0) || !(p.direction.z < 0) || std::abs(hit.x) > half_width ||
            std::abs(hit.y) > half_width) {
            continue;
        }
        PhotonDifferential d = light_differential(l, all_light_kinds, p, radius, photons, photons);
        transfer_differential(d, p.direction, t, vec3(0, 0, 1));
        sum += area_of(d.dp_du, d.dp_dv);
    }
    return sum / (4 * half_width * half_width);
}

TEST(Emission, AreaTimesDensityIsOne) {
    LightRecord l = paths::some_light(Start::point, 1);
    l.x = 0.3f;
    l.y = -0.2f;
    l.z = 1.2f;
    l.dx = 0.1f;
    l.dy = 0;
    l.dz = -std::sqrt(1 - l.dx * l.dx);
    EXPECT_NEAR(area_times_density(l, 0.2, 400'000), 1, 0.03);
    l.kind = light_spot;
    EXPECT_NEAR(area_times_density(l, 0.2, 400'000), 1, 0.03);
    l.kind = light_directional;
    EXPECT_NEAR(area_times_density(l, 0.2, 400'000), 1, 0.03);
    // The sky's spread is split between position and direction so that this holds in the centre of
    // the scene.
    l.kind = light_sky;
    EXPECT_NEAR(area_times_density(l, 0.2, 1'000'000), 1, 0.03);
}

// Emitters: exact for each photon on the axis of a disc. The mean also contains the positions' own
// share, from the tail of slanted photons, which is noticeable within about two diameters
// (docs/methods/footprints.md).
TEST(Emission, AreaTimesDensityOfAnEmitter) {
    LightRecord l{};
    l.kind = light_triangle;
    l.x = 0.5f;
    l.y = l.dy = -0.28867513f;
    l.dx = -0.5f;
    l.ey = 0.57735027f;
    const double area = std::sqrt(3.0) / 4;
    for (const double height : {0.1, 0.3, 1.0, 3.0}) {
        for (const uint both : {0u, 1u}) {
            l.z = l.dz = l.ez = float(height);
            l.triangle_and_sides = both;
            const double disc = area / (area + PI * height * height);
            EXPECT_NEAR(area_times_density(l, 0.05, 1'000'000), 1 + disc, 0.08)
                << "height " << height << ", both sides " << both;
        }
    }
}

} // namespace
} // namespace argand::oracle
