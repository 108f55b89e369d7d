#include "scene/gltf.hpp"
#include "sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace argand::testing {
namespace {

using Values = std::map<std::string, std::set<std::string>>;

/// The values that a sweep tries for each option of a method, on a box with diffuse, glossy and
/// glass surfaces where methods chose a radius of 0.25, 50 neighbours and a smoothing of 1.
Values values(const std::string& method, Extent extent) {
    RenderStatistics learnt;
    learnt.radius = 0.25;
    learnt.neighbours = 50;
    learnt.smoothing = 1;
    Values values;
    for (const Setting& setting : sweep(load_gltf(ARGAND_SOURCE_DIR "/assets/cornell_glass.glb"),
                                        {}, {method}, {{method, learnt}}, extent)) {
        EXPECT_TRUE(values[setting.option].insert(setting.value).second) << setting.key;
    }
    return values;
}

const Values of_all_maps{{"default", {""}},
                         {"spp", {"2", "4", "16", "32"}},
                         {"photons", {"10000", "30000", "100000", "300000", "1000000"}},
                         {"radius", {"0.125", "0.5"}},
                         {"query-cell", {"0", "0.5"}},
                         {"least-coverage", {"0", "0.2"}},
                         {"leaf-size", {"4", "16", "64"}},
                         {"wide-codes", {"on"}},
                         {"photon-sampling", {"random"}},
                         {"final-gather", {"on"}},
                         {"bounces", {"1", "4"}}};

TEST(SweepValues, OfTheFullSweep) {
    EXPECT_EQ(values("path", Extent::full), (Values{{"default", {""}},
                                                    {"spp", {"1", "4", "16", "64", "256"}},
                                                    {"bounces", {"1", "4"}}}));
    Values discs = of_all_maps;
    discs.merge(
        Values{{"kernel", {"uniform"}}, {"support", {"ball"}}, {"query", {"simultaneous"}}});
    EXPECT_EQ(values("photons", Extent::full), discs);
    discs.erase("radius");
    discs.merge(Values{{"passes", {"4", "16", "64"}}, {"r1", {"0.125", "0.5"}}});
    EXPECT_EQ(values("progressive", Extent::full), discs);
    Values knn = of_all_maps;
    knn["k"] = {"25", "100"};
    EXPECT_EQ(values("knn", Extent::full), knn);
    Values footprints = of_all_maps;
    footprints.merge(Values{{"smoothing", {"0.5", "2"}},
                            {"caustic-smoothing", {"2", "8"}},
                            {"flatness", {"0.1", "1"}},
                            {"uniform-kernel", {"on"}},
                            {"query", {"simultaneous"}},
                            {"paper-axes", {"on"}},
                            {"paper-reemission", {"on"}}});
    EXPECT_EQ(values("footprints", Extent::full), footprints);
}

TEST(SweepValues, OfTheQuickSweep) {
    EXPECT_EQ(values("path", Extent::quick),
              (Values{{"default", {""}}, {"spp", {"2", "32", "128"}}}));
    const Values maps{{"default", {""}},
                      {"spp", {"32"}},
                      {"photons", {"10000", "50000", "1000000"}},
                      {"radius", {"0.125", "0.5"}}};
    EXPECT_EQ(values("photons", Extent::quick), maps);
    Values knn = maps;
    knn["k"] = {"25", "100"};
    EXPECT_EQ(values("knn", Extent::quick), knn);
    Values footprints = maps;
    footprints["smoothing"] = {"0.5", "2"};
    EXPECT_EQ(values("footprints", Extent::quick), footprints);
}

} // namespace
} // namespace argand::testing
