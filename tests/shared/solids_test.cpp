// Solids that overlap on a line: what a ray makes of their surfaces, against what is there.
#include "materials.hpp"
#include "shared/solids.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace argand::testing {
namespace {

/// A solid between two places of a line. Its place in the vector is its rank.
struct Slab {
    double near = 0, far = 0;
};

struct Crossing {
    double at = 0;
    std::uint32_t slab = 0;
    bool front = false;
};

std::vector<Crossing> crossings(const std::vector<Slab>& slabs) {
    std::vector<Crossing> all;
    for (std::uint32_t i = 0; i < slabs.size(); ++i) {
        all.push_back({slabs[i].near, i, true});
        all.push_back({slabs[i].far, i, false});
    }
    std::sort(all.begin(), all.end(),
              [](const Crossing& a, const Crossing& b) { return a.at < b.at; });
    return all;
}

/// The highest slab that contains the place, other than `but`; -1: none.
int highest_at(const std::vector<Slab>& slabs, double place, int but = -1) {
    for (int i = static_cast<int>(slabs.size()) - 1; i >= 0; --i) {
        if (i != but && slabs[i].near < place && place < slabs[i].far) {
            return i;
        }
    }
    return -1;
}

TEST(Solids, AreFollowedThroughOneAnother) {
    std::mt19937 bits(5);
    std::uniform_real_distribution<double> place(0, 1);
    for (int round = 0; round < 2000; ++round) {
        std::vector<Slab> slabs(1 + round % most_ranked_solids);
        for (Slab& slab : slabs) {
            const auto [near, far] = std::minmax({place(bits), place(bits)});
            slab = {near, far};
        }
        uint known = 0;
        for (const Crossing& crossing : crossings(slabs)) {
            const uint bit = 1u << crossing.slab;
            const uint before = solids_before(known, bit, crossing.front);
            const int around = highest_at(slabs, crossing.at, static_cast<int>(crossing.slab));
            EXPECT_EQ(is_in_higher_solid(before, bit), around > static_cast<int>(crossing.slab));
            const uint others = before & ~bit;
            EXPECT_EQ(others == 0 ? -1 : static_cast<int>(highest_solid(others)), around);
            const double on_way = crossing.at - 1e-12;
            EXPECT_EQ(before == 0 ? -1 : static_cast<int>(highest_solid(before)),
                      highest_at(slabs, on_way));
            known = solids_behind(before, bit, crossing.front);
        }
        EXPECT_EQ(known, 0u);
    }
}

// A ray that starts inside solids learns of each when it meets its surface from inside.
TEST(Solids, AreFoundByRaysThatStartInside) {
    const uint water = 1, glass = 2;
    EXPECT_EQ(solids_before(0, water, false), water);
    EXPECT_EQ(solids_behind(solids_before(0, water, false), water, false), 0u);
    // Out of the glass first, then out of the water.
    const uint in_water = solids_behind(solids_before(0, glass, false), glass, false);
    EXPECT_EQ(solids_before(in_water, water, false), water);
}

TEST(Solids, WithoutARankHaveNoBitAndAreNeverHidden) {
    MaterialRecord m = glass(1.5f, 1);
    EXPECT_EQ(solid_bit(m), 0u);
    EXPECT_FALSE(is_in_higher_solid(6u, solid_bit(m)));
    for (uint rank = 0; rank < most_ranked_solids; ++rank) {
        m.solids = (77u << solid_of_rank_shift) | (rank + 1);
        EXPECT_EQ(solid_bit(m), 1u << rank);
        EXPECT_EQ(highest_solid(solid_bit(m) | 1u), rank);
    }
}

TEST(Solids, RefractByTheRatioOfIndices) {
    EXPECT_FLOAT_EQ(relative_ior(1.5f, 1.33f), 1.5f / 1.33f);
    EXPECT_FLOAT_EQ(relative_ior(1.31f, 1.31f), 1);
    EXPECT_EQ(relative_ior(0, 1.5f), 0); // reflects all light
    EXPECT_EQ(relative_ior(1.5f, 0), 1.5f);
}

} // namespace
} // namespace argand::testing
