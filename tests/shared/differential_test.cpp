// Differentials in double precision, compared with central differences of traced photons.
#define ARGAND_REAL_DOUBLE
#include "differential_case.hpp"
#include "differential_oracle.hpp"
#include "shared/bsdf.h"
#include "stretch.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

namespace argand::truth {

PathEnd path_end(int start, unsigned seed, unsigned walls) {
    const oracle::paths::Path p = trace(oracle::paths::Start(start), seed, walls, oracle::vec2(0));
    return {p.differential.dp_du, p.differential.dp_dv, p.conditioning};
}

} // namespace argand::truth

namespace argand::oracle {
namespace {

using paths::Start;

/// Difference between both differentials and central differences, relative to the longer one.
double finite_difference_error(Start start, uint seed, uint walls, bool& alike,
                               double& conditioning) {
    const double h = 1e-4;
    const paths::Path center = trace(start, seed, walls, vec2(0));
    conditioning = center.conditioning;
    alike = true;
    double error = 0;
    for (int k = 0; k < 2; ++k) {
        const vec2 step = k == 0 ? vec2(h, 0) : vec2(0, h);
        const paths::Path forth = trace(start, seed, walls, step);
        const paths::Path back = trace(start, seed, walls, -step);
        alike = alike && forth.alike && back.alike;
        const vec3 truth = (forth.neighbour - back.neighbour) / (2 * h);
        const vec3 ours = k == 0 ? center.differential.dp_du : center.differential.dp_dv;
        error = std::max(error, glm::length(ours - truth) / glm::length(truth));
    }
    return error;
}

TEST(Differential, AgreesWithNeighbouringPhotons) {
    for (int start = 0; start < paths::start_count; ++start) {
        for (uint walls = 0; walls <= 4; ++walls) {
            int compared = 0;
            for (uint seed = 0; seed < 500; ++seed) {
                bool alike;
                double conditioning;
                const double error =
                    finite_difference_error(Start(start), seed, walls, alike, conditioning);
                if (alike && conditioning > 0.1) {
                    ++compared;
                    ASSERT_LT(error, 1e-4) << "start " << start << ", walls " << walls << ", seed "
                                           << seed << ", conditioning " << conditioning;
                }
            }
            EXPECT_GT(compared, 150) << "start " << start << ", walls " << walls;
        }
    }
}

const double n = paths::photon_count;

MaterialRecord metal(float roughness) {
    MaterialRecord m{};
    m.base_r = m.base_g = m.base_b = 0.9f;
    m.metallic = 1;
    m.roughness = roughness;
    m.ior = 1.5f;
    m.coverage = 1;
    m.exponent = -1;
    return m;
}

MaterialRecord phong(float exponent) {
    MaterialRecord m = metal(std::pow(2 / (exponent + 2), 0.25f));
    m.metallic = 0;
    m.base_r = m.base_g = m.base_b = 0;
    m.specular_r = m.specular_g = m.specular_b = 0.9f;
    m.specular = 1;
    m.exponent = exponent;
    return m;
}

/// Density of a sampler whose main part stretches the unit square by `stretched`. The rest of the
/// samples of rough metal are of repeated reflection.
double density_of(const MaterialRecord& m, vec3 wo, vec3 wi, double stretched) {
    const ReflectionParameters r = reflection_parameters(m);
    if (!layer_is_rough(r)) {
        return 1 / stretched;
    }
    const double share = double(
        repeated_share(r, ggx_lost(r.alpha, wo.z), repeated_color(r, ggx_lost_average(r.alpha))));
    return (1 - share) / stretched + share * double(ggx_repeated_pdf(r.alpha, wi.z));
}

// The spread of a lobe equals the stretching of the unit square by its sampler.
TEST(Glossy, SpreadMatchesTheSampler) {
    int compared = 0;
    for (const MaterialRecord& m : {metal(0.1f), metal(0.3f), metal(0.6f), metal(1), phong(0),
                                    phong(3), phong(50), phong(1000)}) {
        for (uint seed = 0; seed < 300; ++seed) {
            const vec4 u(random4(54, seed, 0, 0));
            const vec3 wo = glm::normalize(vec3(paths::signed_vector(seed, 1).x, 0.3, 0.2 + u.w));
            const auto direction = [&](vec2 x) {
                BsdfSample s;
                bsdf_sample(m, wo, true, LOBES_ALL, vec4(0.999f, x.x, x.y, 0), s);
                return s.wi;
            };
            BsdfSample s;
            if (u.x < 1e-3 || u.y < 1e-2 || u.y > 0.99 || u.x > 0.999 ||
                !bsdf_sample(m, wo, true, LOBES_ALL, vec4(0.999f, u.x, u.y, 0), s) ||
                s.wi.z < 0.01) {
                continue;
            }
            ++compared;
            PhotonDifferential d = no_differential();
            gloss_differential(d, -wo, s.wi, {vec3(0, 0, 1), vec3(0), vec3(0)}, n, s.pdf);
            const double expected = 1 / (density_of(m, wo, s.wi, stretch(direction, vec2(u))) * n);
            EXPECT_NEAR(area_of(d.dd_du, d.dd_dv), expected, 1e-3 * expected)
                << "roughness " << m.roughness << ", seed " << seed;
        }
    }
    EXPECT_GT(compared, 1400);
}

/// v after the shortest rotation that takes the unit vector a to b.
vec3 turned(vec3 a, vec3 b, vec3 v) {
    const vec3 axis = glm::cross(a, b);
    return v + glm::cross(axis, v) + glm::cross(axis, glm::cross(axis, v)) / (1 + glm::dot(a, b));
}

// The incoming spread is mirrored at a half vector that turns with the surface.
TEST(Glossy, IncomingSpreadIsMirroredAtTheHalfVector) {
    for (uint seed = 0; seed < 300; ++seed) {
        const vec3 normal = paths::unit_vector(seed, 1);
        const vec3 h = glm::normalize(normal + 0.5 * paths::unit_vector(seed, 2));
        const vec3 direction = glm::normalize(-h + 0.7 * paths::unit_vector(seed, 3));
        const vec3 raw_dn = paths::signed_vector(seed, 4);
        const vec3 dn = raw_dn - normal * glm::dot(normal, raw_dn);
        PhotonDifferential d = no_differential();
        const vec3 raw_dd = paths::signed_vector(seed, 5);
        d.dd_du = raw_dd - direction * glm::dot(direction, raw_dd);
        const auto mirrored = [&](double step) {
            const vec3 in = glm::normalize(direction + step * d.dd_du);
            const vec3 at = turned(normal, glm::normalize(normal + step * dn), h);
            return in - 2 * glm::dot(in, at) * at;
        };
        const double step = 1e-6;
        const vec3 truth = (mirrored(step) - mirrored(-step)) / (2 * step);
        gloss_differential(d, direction, mirrored(0), {normal, dn, vec3(0)}, 1e30, 1.0);
        EXPECT_NEAR(glm::length(d.dd_du - truth), 0, 1e-7 * (1 + glm::length(truth)));
    }
}

/// Traces a ray through a ball of radius 1 around the origin: refracted in and out onto z = -3, or
/// mirrored (eta 0) onto z = 4. Returns false if it does not reach the plane or grazes it.
bool past_ball(vec3 origin, vec3 direction, double eta, vec3& end, PhotonDifferential* d) {
    const auto move = [&](double t, bool onto_ball) {
        origin += t * direction;
        if (d != nullptr) {
            transfer_differential(*d, direction, t, onto_ball ? origin : vec3(0, 0, 1));
        }
    };
    const double b = glm::dot(origin, direction);
    move(-b - std::sqrt(b * b - glm::dot(origin, origin) + 1), true);
    for (const double side : {1.0, -1.0}) {
        const vec3 normal = side * origin;
        const double ratio = side > 0 ? eta : 1 / eta;
        const vec3 before = direction;
        direction =
            eta == 0 ? glm::reflect(direction, normal) : glm::refract(direction, normal, 1 / ratio);
        if (direction == vec3(0)) {
            return false; // total reflection
        }
        if (d != nullptr && eta == 0) {
            reflect_differential(*d, before, {normal, d->dp_du, d->dp_dv});
        } else if (d != nullptr) {
            refract_differential(*d, before, {normal, side * d->dp_du, side * d->dp_dv}, ratio);
        }
        if (eta == 0) {
            break;
        }
        if (side > 0) {
            move(-2 * glm::dot(origin, direction), true);
        }
    }
    const double z = eta == 0 ? 4 : -3;
    const double t = (z - origin.z) / direction.z;
    move(t, false);
    end = origin;
    return t > 0 && std::abs(direction.z) > 0.2;
}

TEST(Ball, FocusesLikeTracedPhotons) {
    for (const double eta : {0.0, 1.5, 1.33, 1.0000001, 0.9999999, 0.8, 2.4}) {
        int compared = 0;
        for (uint seed = 0; seed < 300; ++seed) {
            const vec4 u(random4(55, seed, 0, 0));
            const vec3 origin(0.5 * u.x, 0.5 * u.y, 3);
            const vec3 direction = glm::normalize(vec3(0.5 * (u.z - 0.5), 0.5 * (u.w - 0.5), -3));
            PhotonDifferential d = no_differential();
            d.dd_du = glm::normalize(glm::cross(direction, vec3(1, 0, 0)));
            d.dd_dv = glm::cross(direction, d.dd_du);
            const std::array axes = {d.dd_du, d.dd_dv};
            vec3 end;
            if (!past_ball(origin, direction, eta, end, &d)) {
                continue;
            }
            ++compared;
            const double h = 1e-6;
            for (int k = 0; k < 2; ++k) {
                vec3 forth, back;
                past_ball(origin, glm::normalize(direction + h * axes[k]), eta, forth, nullptr);
                past_ball(origin, glm::normalize(direction - h * axes[k]), eta, back, nullptr);
                const vec3 truth = (forth - back) / (2 * h);
                const vec3 ours = k == 0 ? d.dp_du : d.dp_dv;
                EXPECT_NEAR(glm::length(ours - truth), 0, 1e-6 * (1 + glm::length(truth)))
                    << "eta " << eta << ", seed " << seed;
            }
        }
        EXPECT_GT(compared, 200) << "eta " << eta;
    }
}

// Re-emission onto a plane at distance t: the paper's footprints, those by cosine, and those with
// added areas.
TEST(Reemission, FootprintOnAPlane) {
    for (uint seed = 0; seed < 200; ++seed) {
        const Frame frame = make_frame(paths::unit_vector(seed, 1));
        const vec4 u(random4(56, seed, 0, 0));
        const vec3 direction = to_world(frame, sample_cosine_hemisphere(vec2(u)));
        const double emission_cosine = dot3(direction, frame.z);
        PhotonDifferential before = no_differential();
        before.dp_du = frame.x * 0.03 + frame.y * 0.01;
        before.dp_dv = frame.y * (0.002 + 0.04 * u.z);
        const double area = area_of(before.dp_du, before.dp_dv);
        const vec3 plane = glm::normalize(0.8 * paths::unit_vector(seed, 2) - direction);
        const double cosine = -glm::dot(direction, plane);
        const double t = 3 * u.w;
        const auto footprint_at = [&](uint mode, double distance, vec3 normal) {
            PhotonDifferential d = reemitted_differential(before, frame, direction, n, mode);
            transfer_differential(d, direction, distance, normal);
            return area_of(d.dp_du, d.dp_dv);
        };
        const double sphere = 2 * std::sqrt(PI / n);
        const double v = std::sqrt(area) / sphere;
        const double by_paper = sphere * sphere * (v + t) * (v + t) / cosine;
        EXPECT_NEAR(footprint_at(REEMIT_PAPER, t, plane), by_paper, 1e-9 * by_paper);

        const double spread2 = PI / (n * emission_cosine);
        const double size = std::sqrt(area * emission_cosine) + std::sqrt(spread2) * t;
        EXPECT_NEAR(footprint_at(REEMIT_COSINE, t, plane), size * size / cosine,
                    1e-9 * size * size / cosine);
        const double sum = (area * emission_cosine + spread2 * t * t) / cosine;
        EXPECT_NEAR(footprint_at(REEMIT_INDEPENDENT, t, plane), sum, 1e-9 * sum);
        // On the surface itself, both keep the area of the arriving footprint.
        EXPECT_NEAR(footprint_at(REEMIT_COSINE, 0, frame.z), area, 1e-9 * area);
        EXPECT_NEAR(footprint_at(REEMIT_INDEPENDENT, 0, frame.z), area, 1e-9 * area);
    }
}

TEST(Roulette, DividesTheArea) {
    PhotonDifferential d = no_differential();
    d.dp_du = vec3(2, 0, 0);
    d.dp_dv = vec3(1, 3, 0);
    d.dd_du = vec3(0, 1, 0);
    roulette_differential(d, 0.25);
    EXPECT_NEAR(area_of(d.dp_du, d.dp_dv), 6 / 0.25, 1e-12);
    EXPECT_EQ(d.dd_du, vec3(0, 2, 0));
}

} // namespace
} // namespace argand::oracle
