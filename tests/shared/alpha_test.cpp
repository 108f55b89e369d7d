#include "shared/alpha.h"

#include <cmath>
#include <gtest/gtest.h>

namespace argand {
namespace {

TEST(Thickness, MultipliesByWhatPasses) {
    for (const float coverage :
         {0.0f, 1e-7f, 1.0f / 255, 0.25f, 0.5f, 0.75f, 254.0f / 255, 0.9999f}) {
        double passed = 1;
        std::uint32_t sum = 0;
        for (int surfaces = 0; surfaces < 40; ++surfaces) {
            // Half a unit for each surface, and the rounding of the exponent.
            const double bound = passed * (4e-8 * surfaces + 1e-7 * (1 - std::log(passed))) + 1e-38;
            EXPECT_NEAR(transmittance(sum), passed, bound) << coverage << ", " << surfaces;
            sum = add_thickness(sum, thickness_of(coverage));
            passed *= 1 - double(coverage);
        }
    }
    EXPECT_EQ(transmittance(0), 1.0f);
}

TEST(Thickness, OfOpaqueSurfacesIsThatOfAll) {
    EXPECT_EQ(thickness_of(1), thickness_of_all);
    EXPECT_EQ(transmittance(thickness_of_all), 0.0f);
    EXPECT_EQ(add_thickness(3, thickness_of_all), thickness_of_all);
    EXPECT_EQ(add_thickness(thickness_of_all, 3), thickness_of_all);
    const std::uint32_t thick = thickness_of(0x1.fffffep-1f); // the largest below 1
    EXPECT_LT(thick, most_thickness);
    std::uint32_t sum = 0;
    for (int i = 0; i < 100; ++i) { // sums do not wrap
        const std::uint32_t next = add_thickness(sum, thick);
        EXPECT_GE(next, sum);
        sum = next;
    }
    EXPECT_EQ(sum, thickness_of_all);
}

} // namespace
} // namespace argand
