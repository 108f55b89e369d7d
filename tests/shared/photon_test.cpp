#include "mesh.hpp"
#include "oracle.hpp"
#include "shared/photon.h"

#include <gtest/gtest.h>

namespace argand {
namespace {

using testing::any_direction;
using testing::any_magnitude;

TEST(PhotonNormal, ErrorIsBounded) {
    std::mt19937 bits(1);
    double worst = 0;
    for (int i = 0; i < 500'000; ++i) {
        const vec3 n = any_direction(bits);
        const vec3 m = unpack_photon_normal(pack_photon_normal(n, false));
        ASSERT_NEAR(glm::dot(glm::dvec3(m), glm::dvec3(m)), 1, 1e-6);
        worst = std::max(worst, glm::length(glm::cross(glm::dvec3(n), glm::dvec3(m))));
    }
    EXPECT_LT(worst, 2.5e-4);
    EXPECT_GT(worst, 5e-5); // the bound is tight
}

TEST(PhotonNormal, AxesAreAlmostExact) {
    for (const vec3 axis : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(-1, 0, 0),
                            vec3(0, -1, 0), vec3(0, 0, -1)}) {
        EXPECT_GT(dot3(unpack_photon_normal(pack_photon_normal(axis, false)), axis), 1 - 1e-7f);
    }
}

TEST(PhotonNormal, FlagsDoNotAffectTheNormal) {
    std::mt19937 bits(2);
    for (int i = 0; i < 100'000; ++i) {
        const vec3 n = any_direction(bits);
        const uint plain = pack_photon_normal(n, false);
        const uint caustic = pack_photon_normal(n, true);
        ASSERT_EQ(plain & ~photon_normal_mask, 0u);
        ASSERT_EQ(caustic, plain | photon_caustic_bit);
        ASSERT_FALSE(photon_is_caustic(plain));
        ASSERT_TRUE(photon_is_caustic(caustic));
        ASSERT_FALSE(photon_is_caustic(plain | area_sample_bit));
        for (const uint packed : {caustic, plain | area_sample_bit}) {
            ASSERT_EQ(unpack_photon_normal(packed), unpack_photon_normal(plain));
            ASSERT_NE(packed, no_photon);
        }
    }
    // No code of a photon or an area sample equals that of an empty slot.
    EXPECT_NE(photon_normal_mask | photon_caustic_bit, no_photon);
    EXPECT_NE(photon_normal_mask | area_sample_bit, no_photon);
}

TEST(PhotonNormal, SinglePrecisionIsStable) {
    std::mt19937 bits(3);
    int same = 0;
    const int cases = 100'000;
    for (int i = 0; i < cases; ++i) {
        const vec3 n = any_direction(bits);
        const uint packed = pack_photon_normal(n, i % 2 == 0);
        same += packed == truth::pack_photon_normal(glm::dvec3(n), i % 2 == 0);
        const glm::dvec3 truth = truth::unpack_photon_normal(packed);
        ASSERT_LT(glm::length(glm::dvec3(unpack_photon_normal(packed)) - truth), 5e-7);
    }
    EXPECT_GT(same, cases * 0.99); // all but those halfway between two codes
}

TEST(PhotonDirection, IsRoundedToTheNearest) {
    // Where numbers of scatterings and densities fill the lowest bits with zeros, and with ones.
    for (const uint aimed : {0u, 10u, 31u}) {
        for (const uint scatterings : {1u, 63u}) {
            std::mt19937 bits(4);
            double worst = 0;
            glm::dvec3 sum(0);
            const int directions = 100'000;
            for (int i = 0; i < directions; ++i) {
                const vec3 d = glm::abs(any_direction(bits)); // one face of the octahedron
                const vec3 read = unpack_unit(pack_photon_direction(d, scatterings, aimed));
                const glm::dvec3 error = glm::dvec3(read) - glm::dvec3(d);
                worst = std::max(worst, glm::length(error));
                sum += error;
            }
            EXPECT_LT(worst, 3e-3);
            // Coordinates that lie between two numbers are rounded up: by half of 1/32768 in the
            // mean, which turns the direction by up to 4.3 times as much.
            EXPECT_LT(glm::length(sum) / directions, 6.5e-5);
        }
    }
}

TEST(PhotonKernel, IntegratesToOneOverTheDisc) {
    const int steps = 100'000; // midpoints of the squared distance
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double squared = (i + 0.5) / steps;
        const float weight = kernel_weight(float(squared));
        ASSERT_NEAR(weight, truth::kernel_weight(squared), 1.2e-7);
        sum += weight * (3.14159265358979323846 / steps); // dA = π d(r²)
    }
    EXPECT_NEAR(sum * kernel_scale, 1, 1e-6);
}

TEST(PhotonKernel, IsZeroOutsideTheDisc) {
    EXPECT_EQ(kernel_weight(0), 1.0f);
    EXPECT_EQ(kernel_weight(1), 0.0f);
    EXPECT_GT(kernel_weight(std::nextafter(1.0f, 0.0f)), 0.0f);
    for (const float beyond : {1.5f, 3e38f, std::numeric_limits<float>::infinity()}) {
        EXPECT_EQ(kernel_weight(beyond), 0.0f);
    }
}

TEST(FluxUnits, AreRoundedToTheNearest) {
    std::mt19937 bits(4);
    for (int i = 0; i < 100'000; ++i) {
        const float unit = any_magnitude(bits, -60, 60);
        const float flux = unit * any_magnitude(bits, -10, 22);
        const double exact = double(flux) / double(unit);
        // Rounding of the quotient and of the sum, each at most half a unit in the last place of
        // 2^22.
        ASSERT_NEAR(flux_units(flux, unit), exact, 0.5 + 0.5 + 1e-6) << "case " << i;
        if (exact < 0x1p12) {
            ASSERT_NEAR(flux_units(flux, unit), exact, 0.5 + 1e-3) << "case " << i;
        }
    }
    EXPECT_EQ(flux_units(0, 1e-30f), 0u);
    EXPECT_EQ(flux_units(1e-30f, 1e30f), 0u);
    EXPECT_EQ(flux_units(7.0f, 2.0f), 4u);
    EXPECT_EQ(flux_units(1e30f, 1.0f), 4294967040u); // saturates instead of wrapping around
    EXPECT_EQ(flux_units(std::ldexp(3.0f, 100), std::ldexp(1.0f, 100)), 3u);
}

} // namespace
} // namespace argand
