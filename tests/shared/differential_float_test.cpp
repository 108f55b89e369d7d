// Differentials in single precision, compared with double precision and at extreme inputs.
#include "differential_case.hpp"
#include "differential_oracle.hpp"
#include "numbers.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace argand {
namespace {

using paths::Start;
using testing::any_magnitude;

bool finite(const PhotonDifferential& d) {
    return is_finite3(d.dp_du) && is_finite3(d.dp_dv) && is_finite3(d.dd_du) && is_finite3(d.dd_dv);
}

TEST(DifferentialFloat, IsCloseToDoublePrecision) {
    double worst = 0;
    std::vector<double> errors;
    for (int start = 0; start < paths::start_count; ++start) {
        for (uint walls = 0; walls <= 4; ++walls) {
            for (uint seed = 0; seed < 400; ++seed) {
                const paths::Path p = trace(Start(start), seed, walls, vec2(0));
                ASSERT_TRUE(finite(p.differential));
                const truth::PathEnd t = truth::path_end(start, seed, walls);
                if (t.conditioning < 0.1) {
                    continue;
                }
                const double size = std::max(glm::length(t.dp_du), glm::length(t.dp_dv));
                const double error =
                    std::max(glm::length(glm::dvec3(p.differential.dp_du) - t.dp_du),
                             glm::length(glm::dvec3(p.differential.dp_dv) - t.dp_dv)) /
                    size;
                errors.push_back(error);
                worst = std::max(worst, error);
                ASSERT_LT(error, 1e-3) << "start " << start << ", walls " << walls << ", seed "
                                       << seed << ", conditioning " << t.conditioning;
            }
        }
    }
    std::sort(errors.begin(), errors.end());
    RecordProperty("median_error", std::to_string(errors[errors.size() / 2]));
    RecordProperty("worst_error", std::to_string(worst));
    EXPECT_LT(errors[errors.size() / 2], 2e-6);
    EXPECT_GT(errors.size(), 15'000u);
}

/// Every differential in single precision stays finite with bounded directions, whatever it meets.
TEST(DifferentialFloat, ExtremesStayFinite) {
    std::mt19937 bits(3);
    const auto any_vector = [&](int low, int high) {
        const float size = bits() % 5 == 0 ? 0 : any_magnitude(bits, low, high);
        return size * vec3(paths::unit_vector(uint(bits()), 1));
    };
    for (int i = 0; i < 200'000; ++i) {
        const vec3 n = paths::unit_vector(uint(i), 1);
        const Frame frame = make_frame(n);
        // Grazing, down to cosines of 1e-7 and less.
        const float cosine = any_magnitude(bits, -27, 0);
        const vec3 direction = glm::normalize(frame.x - n * cosine);
        const float scale = std::exp2(float(int(bits() % 41) - 20));
        PhotonDifferential d;
        d.dp_du = scale * any_vector(-20, 3);
        d.dp_dv = bits() % 4 == 0 ? d.dp_du : scale * any_vector(-20, 3);
        d.dd_du = any_vector(-20, 10);
        d.dd_dv = bits() % 4 == 0 ? d.dd_du : any_vector(-20, 10);
        transfer_differential(d, direction, scale * any_magnitude(bits, -10, 4), n);
        ASSERT_TRUE(finite(d));
        const vec3 dn[] = {any_vector(-20, 20), any_vector(-20, 20)};
        switch (i % 6) {
        case 0:
            reflect_differential(d, direction, {n, dn[0], dn[1]});
            break;
        case 1: { // near total reflection, and indices close to 1
            const float eta = bits() % 2 == 0 ? 1 + (bits() % 2 == 0 ? 1e-7f : -1e-7f)
                                              : any_magnitude(bits, -2, 2);
            refract_differential(d, direction, {n, dn[0], dn[1]}, eta);
            break;
        }
        case 2:
            d = reemitted_differential(d, frame, -direction, any_magnitude(bits, 0, 30),
                                       uint(bits() % 3));
            break;
        case 3:
            gloss_differential(d, direction, glm::reflect(direction, n), {n, dn[0], dn[1]},
                               any_magnitude(bits, 0, 30),
                               bits() % 3 == 0 ? 0.0f : any_magnitude(bits, -100, 40));
            break;
        case 4:
            roulette_differential(d, bits() % 3 == 0 ? 0.0f : any_magnitude(bits, -40, 1));
            break;
        default:
            gloss_differential(d, direction, direction, {n, dn[0], dn[1]}, 1e5f, 1.0f);
        }
        ASSERT_TRUE(finite(d)) << "case " << i;
        ASSERT_LT(glm::length(d.dd_du), 1.001e3f);
        ASSERT_LT(glm::length(d.dd_dv), 1.001e3f);
        for (int again = 0; again < 20; ++again) {
            transfer_differential(d, direction, 1e6f * scale, n);
            reflect_differential(d, direction, {n, dn[0], dn[1]});
        }
        ASSERT_TRUE(finite(d)) << "case " << i;
    }
}

TEST(DifferentialFloat, IndexOfOneChangesNothing) {
    for (uint i = 0; i < 1000; ++i) {
        const vec3 n = paths::unit_vector(i, 1);
        const vec3 dd = paths::signed_vector(i, 2);
        const vec3 refracted = refracted_spread(dd, -make_frame(n).x * 0.6f - n * 0.8f, n,
                                                paths::signed_vector(i, 3), 1);
        ASSERT_LT(glm::length(refracted - dd), 2e-7f);
    }
}

// Scaling the scene by 2^20 or 2^-20 scales the differentials likewise.
TEST(DifferentialFloat, ScalesWithTheScene) {
    for (const float scale : {0x1p-20f, 0x1p20f}) {
        for (uint i = 0; i < 1000; ++i) {
            const paths::Begin b = paths::begin(Start(3 + i % 5), i);
            PhotonDifferential small = b.differential;
            PhotonDifferential large = small;
            large.dp_du *= scale;
            large.dp_dv *= scale;
            const vec3 n = glm::normalize(paths::unit_vector(i, 1) * 0.5f - b.photon.direction);
            transfer_differential(small, b.photon.direction, 1.5f, n);
            transfer_differential(large, b.photon.direction, 1.5f * scale, n);
            const float size = scale * glm::length(small.dp_du);
            ASSERT_LT(glm::length(large.dp_du - scale * small.dp_du), 1e-6f * size);
            const Frame frame = make_frame(n);
            const uint mode = i % 3;
            small = reemitted_differential(small, frame, n, 1e5f, mode);
            large = reemitted_differential(large, frame, n, 1e5f, mode);
            ASSERT_LT(glm::length(large.dp_du - scale * small.dp_du),
                      1e-6f * scale * glm::length(small.dp_du));
            ASSERT_LT(glm::length(large.dd_du - small.dd_du), 1e-6f * glm::length(small.dd_du));
        }
    }
}

TEST(DifferentialFloat, DegenerateTrianglesHaveFlatNormals) {
    const vec3 n(0, 0, 1);
    const vec3 up[] = {n, glm::normalize(vec3(0.2f, 0, 1)), glm::normalize(vec3(0, 0.2f, 1))};
    const vec3 zero(0);
    const auto change = [&](vec3 v0, vec3 v1, vec3 v2, vec3 shading) {
        return shading_normal_change({v0, v1, v2, up[0], up[1], up[2]}, vec2(0.3f), shading,
                                     vec3(1, 1, 0));
    };
    const vec3 x(1, 0, 0);
    const vec3 y(0, 1, 0);
    const vec3 shading = glm::normalize(up[0] * 0.4f + up[1] * 0.3f + up[2] * 0.3f);
    EXPECT_EQ(change(zero, x, x, shading), zero); // no area
    EXPECT_EQ(change(zero, zero, zero, shading), zero);
    EXPECT_EQ(change(zero, x, y, n), zero); // make_surface fell back to the geometric normal
    EXPECT_GT(glm::length(change(zero, x, y, shading)), 0.1f);
    EXPECT_EQ(change(zero, x, y, -shading), -change(zero, x, y, shading));
    EXPECT_EQ(shading_normal_change({zero, x, y, zero, zero, zero}, vec2(0.3f), n, x),
              zero); // no normals
}

} // namespace
} // namespace argand
