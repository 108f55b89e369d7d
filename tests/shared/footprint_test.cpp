// Footprints in single precision, in which they are always stored; integrals in double.
#include "numbers.hpp"
#include "shared/footprint.h"
#include "shared/photon.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace argand {
namespace {

using testing::any_magnitude;
using testing::rounded;

constexpr double pi = 3.14159265358979323846;

vec3 any_unit(std::mt19937& bits) {
    std::normal_distribution<double> normal;
    return rounded(glm::normalize(glm::dvec3(normal(bits), normal(bits), normal(bits))));
}

/// A scale without compression or clamping.
FootprintScale plain(float flatness) {
    FootprintScale s{};
    s.spacing = 1;
    s.diffuse = 1;
    s.caustic = 1;
    s.radius_min = s.caustic_min = 1e-12f;
    s.radius_max = s.caustic_max = 1e12f;
    s.flatness = flatness;
    return s;
}

/// Semi-axes of a random skewed footprint: lengths in a ratio of up to 30, at any angle above 5
/// degrees.
PhotonDifferential any_skewed(std::mt19937& bits, vec3 normal, float scale) {
    const Frame f = make_frame(normal);
    std::uniform_real_distribution<float> uniform;
    const float turn = 6.2831853f * uniform(bits);
    const float between = 0.09f + 2.9f * uniform(bits);
    PhotonDifferential d = no_differential();
    d.dp_du = (f.x * std::cos(turn) + f.y * std::sin(turn)) * (scale * any_magnitude(bits, 0, 5));
    d.dp_dv = (f.x * std::cos(turn + between) + f.y * std::sin(turn + between)) * scale;
    return d;
}

FootprintDuals stored_duals(const Footprint& f, vec3 normal) {
    const FootprintDuals duals = footprint_duals(f, normal);
    const uvec2 a = pack_dual(duals.a);
    const uvec2 b = pack_dual(duals.b);
    return {unpack_dual(a.x, a.y), unpack_dual(b.x, b.y)};
}

double area_of(vec3 u, vec3 v) { return glm::length(glm::cross(glm::dvec3(u), glm::dvec3(v))); }

TEST(Footprint, AreaAndAxesMatchThePaper) {
    std::mt19937 bits(1);
    for (int i = 0; i < 2000; ++i) {
        const vec3 n = any_unit(bits);
        const float scale = std::exp2(float(int(bits() % 41) - 20));
        const PhotonDifferential d = any_skewed(bits, n, scale);
        const Footprint f = make_footprint(d, n, true, plain(0.5f));
        const double area = area_of(d.dp_du, d.dp_dv);
        ASSERT_NEAR(footprint_area(f), pi * area, 1e-5 * pi * area); // eq. 10
        ASSERT_LT(glm::length(f.u - d.dp_du), 1e-6f * glm::length(d.dp_du));
        ASSERT_LT(glm::length(f.v - d.dp_dv), 1e-6f * glm::length(d.dp_dv));
        ASSERT_NEAR(glm::length(f.w), 0.5 * std::sqrt(area), 1e-5 * std::sqrt(area));
        const FootprintDuals duals = footprint_duals(f, n);
        ASSERT_NEAR(dot3(duals.a, f.u), 1, 1e-4);
        ASSERT_NEAR(dot3(duals.b, f.v), 1, 1e-4);
        ASSERT_NEAR(dot3(duals.a, f.v), 0, 1e-4);
        ASSERT_NEAR(dot3(duals.b, f.u) * scale, 0, 3e-3 * scale);
    }
}

/// Integral over the plane with normal m through the photon.
double flux_on_plane(const FootprintDuals& duals, vec3 normal, vec3 m, double reach, float flatness,
                     bool uniform_kernel) {
    const Frame f = make_frame(m);
    const int steps = 500;
    const double cell = 2 * reach / steps;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const vec3 offset =
                f.x * float((i + 0.5) * cell - reach) + f.y * float((j + 0.5) * cell - reach);
            sum += footprint_weight(duals, normal, m, offset, flatness, uniform_kernel);
        }
    }
    return sum * cell * cell;
}

// On its own plane and on any other, from the stored footprint.
TEST(Footprint, FluxIsConservedOnPlanes) {
    std::mt19937 bits(2);
    for (int i = 0; i < 60; ++i) {
        const vec3 n = any_unit(bits);
        const float scale = std::exp2(float(int(bits() % 41) - 20));
        const float flatness = any_magnitude(bits, -3, 1);
        PhotonDifferential d = any_skewed(bits, n, scale);
        d.dp_du *= any_magnitude(bits, -4, 0);
        const Footprint f = make_footprint(d, n, true, plain(flatness));
        const FootprintDuals duals = stored_duals(f, n);
        const vec3 m = i % 2 == 0 ? n : glm::normalize(n + 0.9f * any_unit(bits));
        // The intersection's half-axes in the tangent plane and the ellipsoid's size bound its
        // extent.
        const double reach = glm::length(glm::dvec3(f.u)) + glm::length(glm::dvec3(f.v)) +
                             glm::length(glm::dvec3(f.w));
        const double thin = area_of(f.u, f.v) / (glm::length(f.u) + glm::length(f.v));
        if (std::min(thin, double(glm::length(f.w))) < 0.03 * reach) {
            continue; // too thin for this grid
        }
        EXPECT_NEAR(flux_on_plane(duals, n, m, reach, flatness, true), 1, 0.03) << "case " << i;
        EXPECT_NEAR(flux_on_plane(duals, n, m, reach, flatness, false), 1, 3e-3) << "case " << i;
    }
}

TEST(Footprint, IsZeroOutsideTheEllipsoid) {
    std::mt19937 bits(3);
    for (int i = 0; i < 2000; ++i) {
        const vec3 n = any_unit(bits);
        const Footprint f = make_footprint(any_skewed(bits, n, 1), n, true, plain(0.3f));
        const FootprintDuals duals = stored_duals(f, n);
        const glm::dvec3 s = glm::normalize(glm::dvec3(any_unit(bits)));
        const glm::dvec3 rim =
            s.x * glm::dvec3(f.u) + s.y * glm::dvec3(f.v) + s.z * glm::dvec3(f.w);
        EXPECT_GT(footprint_weight(duals, n, n, vec3(0.99 * rim), 0.3f, true), 0.0f);
        EXPECT_EQ(footprint_weight(duals, n, n, vec3(1.01 * rim), 0.3f, true), 0.0f);
        // Epanechnikov's kernel falls to 0 there, and is twice the uniform one in the centre.
        const float center = footprint_weight(duals, n, n, vec3(0), 0.3f, true);
        EXPECT_NEAR(footprint_weight(duals, n, n, vec3(0), 0.3f, false), 2 * center, 1e-5 * center);
        EXPECT_LT(footprint_weight(duals, n, n, vec3(0.99 * rim), 0.3f, false), 0.06f * center);
    }
}

TEST(Footprint, BoxContainsTheEllipsoidTightly) {
    std::mt19937 bits(4);
    for (int i = 0; i < 500; ++i) {
        const vec3 n = any_unit(bits);
        const float scale = std::exp2(float(int(bits() % 81) - 40));
        const Footprint f = make_footprint(any_skewed(bits, n, scale), n, true, plain(0.3f));
        const vec3 extent = footprint_extent(f);
        for (int axis = 0; axis < 3; ++axis) {
            // The ellipsoid's extreme point along an axis is where (s.u, s.v, s.w) is parallel to
            // that row.
            const glm::dvec3 row(f.u[axis], f.v[axis], f.w[axis]);
            const double reach = glm::length(row);
            EXPECT_NEAR(extent[axis], reach, 1e-6 * reach);
        }
        for (int k = 0; k < 100; ++k) {
            const vec3 s = any_unit(bits);
            const vec3 point = s.x * f.u + s.y * f.v + s.z * f.w;
            EXPECT_TRUE(glm::all(glm::lessThanEqual(glm::abs(point), extent * 1.000001f)));
        }
        // The bounding box of the stored footprint is almost that of the original one, and contains
        // all of it.
        const FootprintDuals duals = stored_duals(f, n);
        const vec3 normal = unpack_photon_normal(pack_photon_normal(n, true));
        const vec3 kept = footprint_extent(footprint_of_duals(duals, normal, 0.3f));
        EXPECT_LT(glm::length(kept - extent), 5e-3f * glm::length(extent));
        for (int k = 0; k < 300; ++k) {
            const vec3 s = any_unit(bits) * (0.98f + 0.0001f * float(k));
            const vec3 point = s.x * f.u + s.y * f.v + s.z * f.w;
            if (footprint_weight(duals, normal, normal, point, 0.3f, true) > 0) {
                EXPECT_TRUE(glm::all(glm::lessThanEqual(glm::abs(point), kept * 1.00001f)));
            }
        }
    }
}

// Effect of the 16-bit components of dual axes on distances and on the area.
TEST(Footprint, PackingKeepsTheEllipse) {
    std::mt19937 bits(5);
    double worst_area = 0;
    double worst_distance = 0;
    for (int i = 0; i < 20'000; ++i) {
        const vec3 n = any_unit(bits);
        const float scale = std::exp2(float(int(bits() % 81) - 40));
        const Footprint f = make_footprint(any_skewed(bits, n, scale), n, true, plain(0.3f));
        const FootprintDuals kept = stored_duals(f, n);
        const double area = 1 / area_of(kept.a, kept.b);
        worst_area = std::max(worst_area, std::abs(area / area_of(f.u, f.v) - 1));
        const float turn = float(bits()) * 0x1p-32f * 6.2831853f;
        const vec3 rim = f.u * std::cos(turn) + f.v * std::sin(turn);
        const double q = std::pow(dot3(kept.a, rim), 2) + std::pow(dot3(kept.b, rim), 2);
        worst_distance = std::max(worst_distance, std::abs(q - 1));
    }
    RecordProperty("worst_area_error", std::to_string(worst_area));
    RecordProperty("worst_distance_error", std::to_string(worst_distance));
    EXPECT_LT(worst_area, 2e-3);
    EXPECT_LT(worst_distance, 1e-2);
}

TEST(Footprint, DegenerateDifferentialsHaveFootprints) {
    std::mt19937 bits(6);
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float length : {1e-3f, 1.0f, 1e3f, 1e6f}) {
        FootprintScale s =
            make_footprint_scale(1e5f, 1e5f, length, {40.0f, 5.0f, 0.05f, 0.3f, 1.0f / 6});
        for (int i = 0; i < 4000; ++i) {
            const vec3 n = any_unit(bits);
            PhotonDifferential d = any_skewed(bits, n, length * any_magnitude(bits, -60, 30));
            switch (i % 8) {
            case 0:
                d.dp_dv = d.dp_du;
                break;
            case 1:
                d.dp_du = d.dp_dv = vec3(0);
                break;
            case 2:
                d.dp_du = vec3(0);
                break;
            case 3:
                d.dp_dv = d.dp_du * -1e-20f;
                break;
            case 4:
                d.dp_du = vec3(infinity);
                break;
            case 5:
                d.dp_dv = vec3(std::numeric_limits<float>::quiet_NaN());
                break;
            case 6:
                d.dp_du = n * length;
                break; // nothing lies in the plane
            default:
                break;
            }
            s.principal_axes = uint(i / 8) % 2;
            const Footprint f = make_footprint(d, n, i % 16 < 8, s);
            ASSERT_TRUE(is_finite3(f.u) && is_finite3(f.v) && is_finite3(f.w)) << "case " << i;
            const float longest = std::max(glm::length(f.u / length), glm::length(f.v / length));
            ASSERT_LT(longest, 0.05f * 1.00001f) << "case " << i;
            ASSERT_GT(longest, 0.99e-6f) << "case " << i;
            // The narrowest width is about radius_min.
            ASSERT_GT(area_of(f.u / length, f.v / length), 0.99e-6 * longest) << "case " << i;
            const FootprintDuals duals = stored_duals(f, n);
            const float weight = footprint_weight(duals, n, n, vec3(0), s.flatness, false);
            ASSERT_TRUE(is_finite(weight) && weight > 0) << "case " << i;
            ASSERT_TRUE(is_finite3(footprint_extent(f)));
        }
    }
}

// Radii by the paper's formula: s Δ |∂p|^(1/4), with |∂p| and s in the units of its scene.
TEST(FootprintScaling, FollowsThePaper) {
    const double photons = 256'000;
    const double spacing = 2 * std::sqrt(pi / photons);
    const double length = 30; // of the scene
    const double paper_smoothing = 40;
    const FootprintScale s = make_footprint_scale(
        float(photons), 1e5f, float(length),
        {float(paper_smoothing / std::pow(length, 0.75)), 5.0f, 10.0f, 0.3f, 0.5f});
    for (const double offset : {0.5, 5.0, 18.0, 40.0}) {
        PhotonDifferential d = no_differential();
        d.dp_du = vec3(offset * spacing, 0, 0);
        d.dp_dv = vec3(0, 2 * offset * spacing, 0);
        const Footprint diffuse = make_footprint(d, vec3(0, 0, 1), false, s);
        const double expected = paper_smoothing * spacing * offset * std::pow(offset, -0.75);
        EXPECT_NEAR(glm::length(diffuse.u), expected, 1e-5 * expected);
        EXPECT_NEAR(glm::length(diffuse.v), expected * std::pow(2, 0.25), 1e-5 * expected);
        const Footprint caustic = make_footprint(d, vec3(0, 0, 1), true, s);
        EXPECT_NEAR(glm::length(caustic.u), 5 * spacing * offset, 1e-5 * spacing * offset);
    }
}

// By default radii shrink as photons^-1/6. At the reference count the exponent does not matter.
TEST(FootprintScaling, ShrinksWithTheExponent) {
    const auto radius = [](double photons, double exponent, bool caustic) {
        const FootprintScale s =
            make_footprint_scale(float(photons), 1e5f, 1, {3, 5, 10, 0.3f, float(exponent)});
        PhotonDifferential d = no_differential();
        const float size =
            // Proportional to the differentials of emission.
            0.7f * float(2 * std::sqrt(pi / photons));
        d.dp_du = vec3(size, 0, 0);
        d.dp_dv = vec3(0, size, 0);
        return double(make_footprint(d, vec3(0, 0, 1), caustic, s).u.x);
    };
    for (const bool caustic : {false, true}) {
        EXPECT_NEAR(radius(1e5, 0.5, caustic), radius(1e5, 1.0 / 6, caustic), 1e-6);
        for (const double exponent : {0.5, 1.0 / 6, 0.25}) {
            const double ratio = radius(1e6, exponent, caustic) / radius(1e4, exponent, caustic);
            EXPECT_NEAR(ratio, std::pow(100, -exponent), 1e-5) << "exponent " << exponent;
        }
    }
}

// Footprints scale with the scene.
TEST(FootprintScaling, ScalesWithTheScene) {
    std::mt19937 bits(7);
    for (const float factor : {1e-6f, 1e-3f, 1e3f, 1e6f}) {
        const FootprintScale one =
            make_footprint_scale(1e6f, 1e5f, 1, {3, 5, 0.1f, 0.3f, 1.0f / 6});
        const FootprintScale other =
            make_footprint_scale(1e6f, 1e5f, factor, {3, 5, 0.1f, 0.3f, 1.0f / 6});
        for (int i = 0; i < 1000; ++i) {
            const vec3 n = any_unit(bits);
            PhotonDifferential d = any_skewed(bits, n, 1e-3f);
            const Footprint f = make_footprint(d, n, i % 2 == 0, one);
            d.dp_du *= factor;
            d.dp_dv *= factor;
            const Footprint g = make_footprint(d, n, i % 2 == 0, other);
            ASSERT_LT(glm::length(g.u / factor - f.u), 3e-6f * glm::length(f.u));
            ASSERT_LT(glm::length(g.v / factor - f.v), 3e-6f * glm::length(f.v));
            ASSERT_LT(glm::length(g.w / factor - f.w), 3e-5f * glm::length(f.w));
        }
    }
}

TEST(Footprint, PrincipalAxesAreThoseOfTheEllipse) {
    std::mt19937 bits(8);
    for (int i = 0; i < 5000; ++i) {
        const vec3 n = any_unit(bits);
        const PhotonDifferential d = any_skewed(bits, n, 1);
        vec3 u = i % 2 == 0 ? d.dp_du : d.dp_dv;
        vec3 v = i % 2 == 0 ? d.dp_dv : d.dp_du;
        make_principal(u, v);
        EXPECT_NEAR(dot3(u, v), 0, 2e-6 * glm::length(u) * glm::length(d.dp_du));
        EXPECT_GE(glm::length(u), glm::length(v) * 0.999999f);
        EXPECT_NEAR(area_of(u, v), area_of(d.dp_du, d.dp_dv),
                    1e-5 * glm::length(u) * glm::length(d.dp_du));
        // The same ellipse: u uᵀ + v vᵀ.
        for (int k = 0; k < 3; ++k) {
            const double before = d.dp_du[k] * d.dp_du[k] + d.dp_dv[k] * d.dp_dv[k];
            EXPECT_NEAR(u[k] * u[k] + v[k] * v[k], before, 1e-5 * dot3(u, u));
        }
    }
    vec3 u(3, 0, 0);
    vec3 v(0, 3, 0);
    make_principal(u, v);
    EXPECT_EQ(u, vec3(3, 0, 0));
}

} // namespace
} // namespace argand
