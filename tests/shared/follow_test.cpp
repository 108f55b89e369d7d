#include "materials.hpp"
#include "shared/follow.h"

#include <gtest/gtest.h>
#include <regex>
#include <string>

namespace argand {
namespace {

using namespace argand::testing;

TEST(Follow, EachLobeIsEitherFollowedOrEstimated) {
    std::mt19937 bits(1);
    for (int i = 0; i < 20'000; ++i) {
        const MaterialRecord m = any_material(bits);
        const float limit = bits() % 3 == 0 ? float(bits() % 2) : to_unit_float(bits);
        const uint followed = followed_lobes(m, limit);
        const uint estimated = estimated_lobes(m, limit);
        ASSERT_EQ(followed & estimated, 0u);
        ASSERT_EQ(followed | estimated, bsdf_lobes(m));
        ASSERT_EQ(followed & LOBE_DIFFUSE, 0u);
        ASSERT_EQ(estimated & LOBES_DELTA, 0u);
        // A higher limit follows a superset of lobes.
        const float higher = limit + (1 - limit) * to_unit_float(bits);
        ASSERT_EQ(followed & ~followed_lobes(m, higher), 0u);
    }
}

TEST(Follow, GlossyLobesAreFollowedUpToTheLimit) {
    for (const float roughness : {0.1f, 0.25f, 1.0f}) {
        const MaterialRecord m = metal(vec3(1), roughness);
        ASSERT_EQ(bsdf_lobes(m), LOBE_GLOSSY);
        EXPECT_EQ(followed_lobes(m, roughness), LOBE_GLOSSY);
        EXPECT_EQ(followed_lobes(m, std::nextafter(roughness, 2.0f)), LOBE_GLOSSY);
        EXPECT_EQ(followed_lobes(m, std::nextafter(roughness, 0.0f)), 0u);
        EXPECT_EQ(followed_lobes(m, 0), 0u);
    }
    EXPECT_EQ(followed_lobes(metal(vec3(1), 0), 0), LOBE_MIRROR);
    EXPECT_EQ(estimated_lobes(metal(vec3(1), 0), 0), 0u);
    EXPECT_EQ(estimated_lobes(lambertian(vec3(0.5f)), 1), LOBE_DIFFUSE);
    EXPECT_NE(followed_lobes(glass(1.5f, 1), 0) & LOBE_TRANSMIT, 0u);
}

// Compares every sequence of up to ten scatterings with the expressions in docs/path-classes.md.
TEST(Follow, LayersMatchThePathClasses) {
    const std::regex direct("F*S?");
    const std::regex caustic("F*SF+");
    for (int length = 0; length <= 10; ++length) {
        for (uint choice = 0; choice < 1u << length; ++choice) {
            std::string path;
            uint state = 0;
            for (int i = 0; i < length; ++i) {
                const bool followed = (choice >> i & 1) != 0;
                path += followed ? 'F' : 'S';
                state = state_after(state, followed);
            }
            const uint expected = std::regex_match(path, direct)    ? layer_direct
                                  : std::regex_match(path, caustic) ? layer_caustic
                                                                    : layer_indirect;
            ASSERT_EQ(layer_of_emission(state), expected) << path;
            const std::size_t first = path.find('S');
            ASSERT_EQ(state & path_depth_mask,
                      first == std::string::npos ? 0 : path.size() - first - 1)
                << path;
        }
    }
}

TEST(Follow, LongPathsKeepTheirClass) {
    uint caustic = state_after(0, false);
    uint indirect = state_after(state_after(0, false), false);
    for (uint i = 1; i < path_depth_mask; ++i) {
        caustic = state_after(caustic, true);
        ASSERT_EQ(layer_of_emission(caustic), layer_caustic) << "case " << i;
        ASSERT_EQ(caustic & path_depth_mask, i);
        if (i > 1) {
            indirect = state_after(indirect, i % 2 == 0);
        }
        ASSERT_EQ(layer_of_emission(indirect), layer_indirect) << "case " << i;
        ASSERT_EQ(indirect & path_depth_mask, i);
    }
}

} // namespace
} // namespace argand
