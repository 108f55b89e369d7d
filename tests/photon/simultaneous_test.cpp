// Simultaneous search: the pairs of queries and photons in its leaves against all pairs in double
// precision, its estimates against those that go through the tree, and its statistics.
#include "base/error.hpp"
#include "device_fixture.hpp"
#include "photon/frontier.hpp"
#include "photon/map_queries.hpp"
#include "shared/photon.h"
#include "shared/segments.h"
#include "world/world.hpp"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <random>

namespace argand::testing {
namespace {

using Positions = std::vector<glm::vec3>;

/// Pairs of a query and a photon. Equal sums are equal sets in which no pair occurs twice, but with
/// a probability of 2^-64.
struct PairSum {
    std::uint64_t number = 0;
    std::uint64_t sum = 0; ///< of hashes

    void add(std::uint64_t query, std::uint64_t photon) {
        std::uint64_t hash = query << 32 | photon;
        hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9ull;
        hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebull;
        sum += hash ^ (hash >> 31);
        ++number;
    }
    bool operator==(const PairSum&) const = default;
};

bool is_within(glm::vec3 a, glm::vec3 b, double radius) {
    const glm::dvec3 d = glm::dvec3(a) - glm::dvec3(b);
    return glm::dot(d, d) <= radius * radius;
}

PairSum all_pairs(const Positions& queries, const Positions& photons, double radius) {
    PairSum pairs;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        for (std::size_t j = 0; j < photons.size(); ++j) {
            if (is_within(queries[i], photons[j], radius)) {
                pairs.add(i, j);
            }
        }
    }
    return pairs;
}

/// What a search has put into leaves.
struct Leaves {
    PairSum within;               ///< pairs within the radius
    std::uint64_t pairs = 0;      ///< all
    std::uint64_t references = 0; ///< to photons
    std::uint64_t number = 0;
    std::uint64_t most_queries = 0; ///< of a leaf
    FrontierStatistics statistics;
};

class SimultaneousSearch : public RenderTest {
protected:
    SimultaneousSearch() : random_(17) {}

    /// The map of these photons, and of slots between them that hold none.
    void store_photons(Device& device, const Positions& photons) {
        std::vector<PhotonRecord> records;
        records.reserve(photons.size() + photons.size() / 5 + 1);
        for (const glm::vec3 p : photons) {
            PhotonRecord record{.x = p.x, .y = p.y, .z = p.z};
            record.normal = pack_photon_normal({0, 1, 0}, records.size() % 3 == 0);
            records.push_back(record);
            if (records.size() % 6 == 0) {
                record.normal = no_photon;
                records.push_back(record);
            }
        }
        DeviceScene scene;
        scene.record.radius = 1;
        scene.scene = upload(device, "scene", std::vector<SceneRecord>{scene.record});
        PhotonWorkspace workspace = make_photon_workspace(device, records.size());
        map_ = build_photon_map(device, scene, workspace, store(device, workspace, records),
                                {.frontier = FrontierSettings()});
        photons_.clear();
        photons_.reserve(photons.size());
        for (const PhotonRecord& p : download<PhotonRecord>(device, map_.photons, photons.size())) {
            photons_.emplace_back(p.x, p.y, p.z);
        }
    }

    Leaves search(Device& device, const Positions& queries, double radius,
                  const FrontierSettings& settings) {
        std::vector<Query> points;
        points.reserve(queries.size());
        for (const glm::vec3 p : queries) {
            points.push_back({.position = p});
        }
        const PhotonQueries on_device = upload_queries(device, points, {});
        Leaves found;
        search_simultaneously(
            device, map_, on_device, radius, settings,
            [&](const FrontierLeaves& leaves) { collect(device, leaves, queries, radius, found); },
            &found.statistics);
        const FrontierStatistics& s = found.statistics;
        EXPECT_EQ(s.photons, queries.empty() ? 0 : photons_.size());
        EXPECT_LE(s.entered, s.photons);
        EXPECT_GE(s.box_tests, s.photons);
        EXPECT_EQ(s.leaves, found.number);
        EXPECT_EQ(s.pairs, found.pairs);
        EXPECT_GE(s.pairs, found.within.number);
        EXPECT_EQ(s.entered - s.discarded + s.replicated, found.references);
        return found;
    }

    void expect_all_pairs(Device& device, const Positions& queries, double radius,
                          const FrontierSettings& settings = {}) {
        EXPECT_EQ(search(device, queries, radius, settings).within,
                  all_pairs(queries, photons_, radius))
            << radius;
    }

    float uniform(float low = -1, float high = 1) {
        return std::uniform_real_distribution<float>(low, high)(random_);
    }
    glm::vec3 in_cube() { return {uniform(), uniform(), uniform()}; }

    template <class Place> static Positions positions(std::size_t count, const Place& place) {
        Positions some(count);
        std::generate(some.begin(), some.end(), place);
        return some;
    }

    /// In clusters of all sizes, far from the origin.
    Positions clustered(std::size_t count) {
        constexpr glm::vec3 origin(20, -7, 3);
        return positions(count, [&] {
            const auto k = static_cast<std::uint32_t>(random_() % 9);
            const glm::vec3 center(std::sin(float(k)), std::cos(float(3 * k)), 0.1f * float(k));
            return origin + center + in_cube() * std::exp2(-2 * float(k));
        });
    }

    /// At few coordinates: many points coincide, and many distances equal multiples of 1/8.
    Positions on_grid(std::size_t count) {
        return positions(count, [&] { return glm::round(in_cube() * 4.0f) / 8.0f; });
    }

    PhotonMap map_;
    Positions photons_; ///< in the order of the map
    std::mt19937 random_;

private:
    void collect(Device& device, const FrontierLeaves& leaves, const Positions& queries,
                 double radius, Leaves& found) const {
        const std::uint32_t count = leaves.end - leaves.first;
        const auto places = download<glm::uvec4>(device, leaves.places, count, leaves.first);
        const auto segments = download<std::uint32_t>(device, leaves.segments, count, leaves.first);
        std::uint32_t node_count = 0;
        for (const std::uint32_t segment : segments) {
            node_count = segment == no_segment ? node_count : std::max(node_count, segment + 1);
        }
        const auto nodes = download<FrontierNode>(device, leaves.nodes, node_count);
        std::uint32_t most = 0;
        std::uint32_t end = 0;
        std::vector<std::uint32_t> queries_of(node_count, 0);
        for (const std::uint32_t segment : segments) {
            if (segment != no_segment && nodes[segment].state == frontier_leaf) {
                const FrontierNode& node = nodes[segment];
                most = std::max(most, node.count);
                end = std::max(end, node.first + node.count);
                if (queries_of[segment]++ == 0) {
                    ++found.number;
                    found.references += node.count;
                }
                found.most_queries =
                    std::max<std::uint64_t>(found.most_queries, queries_of[segment]);
            }
        }
        EXPECT_EQ(most, leaves.most_photons);
        const auto references = download<glm::uvec4>(device, leaves.references, end);
        std::size_t misplaced = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (segments[i] == no_segment || nodes[segments[i]].state != frontier_leaf) {
                continue;
            }
            const std::uint32_t slot = places[i].w;
            misplaced += glm::uintBitsToFloat(glm::uvec3(places[i])) != queries[slot];
            const FrontierNode& node = nodes[segments[i]];
            for (std::uint32_t j = node.first; j < node.first + node.count; ++j) {
                const std::uint32_t photon = references[j].w;
                misplaced += glm::uintBitsToFloat(glm::uvec3(references[j])) != photons_[photon];
                if (is_within(queries[slot], photons_[photon], radius)) {
                    found.within.add(slot, photon);
                }
            }
            found.pairs += node.count;
        }
        EXPECT_EQ(misplaced, 0u);
    }
};

class SimultaneousVariants : public SimultaneousSearch,
                             public ::testing::WithParamInterface<DeviceSetting> {};

TEST_P(SimultaneousVariants, PairsAreThoseOfBruteForce) {
    Device& device = open(GetParam());
    for (const bool grid : {false, true}) {
        store_photons(device, grid ? on_grid(801) : clustered(801));
        const Positions queries = grid ? on_grid(603) : clustered(603);
        for (const double radius : {0.0, 0.125, 1.0}) {
            expect_all_pairs(device, queries, radius);
        }
        expect_all_pairs(device, queries, 0.125, {.query_leaf = 1, .partition_cost = 0});
    }
}

INSTANTIATE_VARIANTS(SimultaneousVariants);

TEST_F(SimultaneousSearch, PhotonsAndQueriesInAllShapes) {
    const auto on_line = [&](glm::vec3 direction) {
        return positions(700, [&] { return direction * uniform(); });
    };
    const Positions some = positions(700, [&] { return in_cube(); });
    const Positions in_one_point(700, {0.25f, -0.5f, 0.125f});
    const std::vector<Positions> shapes{some,
                                        clustered(700),
                                        on_line({1, 0, 0}),
                                        on_line({0.3f, -0.7f, 0.2f}),
                                        in_one_point,
                                        {{0.2f, -0.5f, 0.1f}},
                                        {}};
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        store_photons(device(), shapes[i]);
        for (std::size_t j = 0; j < shapes.size(); ++j) {
            SCOPED_TRACE(::testing::Message() << "photons " << i << ", queries " << j);
            for (const double radius : {0.0, 0.1, 40.0}) {
                expect_all_pairs(device(), shapes[j], radius);
            }
        }
    }
}

TEST_F(SimultaneousSearch, SettingsDoNotChangeThePairs) {
    for (const bool spread : {false, true}) {
        const auto place = [&] { return in_cube(); };
        store_photons(device(), spread ? positions(1999, place) : clustered(1999));
        const Positions queries = spread ? positions(1501, place) : clustered(1501);
        const double radius = spread ? 0.1 : 0.02;
        const PairSum expected = all_pairs(queries, photons_, radius);
        EXPECT_GT(expected.number, 1'000u);
        for (const std::uint32_t query_leaf : {1u, 8u, 64u}) {
            for (const float cost : {0.0f, 8.0f}) {
                for (const std::uint32_t partitions : {1u, 2u, 3u}) {
                    SCOPED_TRACE(::testing::Message() << spread << ", " << query_leaf << ", "
                                                      << cost << ", " << partitions);
                    const Leaves found = search(device(), queries, radius,
                                                {.query_leaf = query_leaf,
                                                 .partition_cost = cost,
                                                 .partitions = partitions});
                    EXPECT_EQ(found.within, expected);
                    EXPECT_LT(found.pairs, 0.5 * 1999 * 1501);
                    // Where photons are not in many leaves each, there is room for all divisions.
                    if (spread) {
                        EXPECT_EQ(found.statistics.waits, 0u);
                        EXPECT_TRUE(cost > 0 || found.most_queries <= query_leaf);
                    }
                }
            }
        }
    }
}

TEST_F(SimultaneousSearch, TenThousandByTenThousand) {
    store_photons(device(), positions(10'000, [&] { return in_cube(); }));
    const Positions queries = positions(10'000, [&] { return in_cube(); });
    for (const double radius : {0.05, 4.0}) {
        expect_all_pairs(device(), queries, radius);
    }
}

// With little memory photons come in batches and parts of a level wait; where not even these have
// room, leaves are larger.
TEST_F(SimultaneousSearch, LittleMemoryDoesNotChangeThePairs) {
    store_photons(device(), clustered(2 * least_frontier_references));
    const Positions queries = clustered(503);
    const PairSum expected = all_pairs(queries, photons_, 0.1);
    std::uint64_t most_queries = 0;
    for (const std::uint64_t sixteenths : {16, 17, 40, 64}) {
        std::uint64_t waits = 0;
        for (const std::uint32_t partitions : {1u, 3u}) {
            SCOPED_TRACE(::testing::Message() << sixteenths << "/16, " << partitions);
            const Leaves found = search(device(), queries, 0.1,
                                        {.query_leaf = 4,
                                         .partition_cost = 0,
                                         .partitions = partitions,
                                         .memory = least_frontier_memory * sixteenths / 16});
            EXPECT_EQ(found.within, expected);
            most_queries = std::max(most_queries, found.most_queries);
            waits += found.statistics.waits;
        }
        EXPECT_GT(waits, 0u);
    }
    EXPECT_GT(most_queries, 4u);
}

TEST_F(SimultaneousSearch, TooLittleMemoryIsAnError) {
    store_photons(device(), {{0, 0, 0}});
    try {
        search(device(), {{0, 0, 0}}, 1, {.memory = least_frontier_memory - 1});
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr(std::to_string(least_frontier_memory)));
    }
}

TEST_F(SimultaneousSearch, PhotonsFarFromAllQueriesDoNotEnter) {
    Positions photons = positions(3'000, [&] { return in_cube(); });
    for (std::size_t i = 0; i < photons.size(); i += 3) {
        photons[i] += glm::vec3(0, i % 2 == 0 ? 3.2f : -3.2f, 0);
    }
    store_photons(device(), photons);
    const Leaves found =
        search(device(), positions(2'000, [&] { return in_cube(); }), 0.15, FrontierSettings());
    EXPECT_EQ(found.statistics.entered, 2'000u);
    EXPECT_EQ(search(device(), {{9, 9, 9}}, 0.15, {}).statistics.entered, 0u);
}

/// Points for nanoflann.
struct Cloud {
    const Positions& points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return points[i][static_cast<int>(axis)];
    }
    template <class Box> bool kdtree_get_bbox(Box&) const { return false; }
};

/// A result set for nanoflann: the pairs of a query.
class PairsOfQuery {
public:
    PairsOfQuery(const Positions& queries, std::size_t query, const Positions& photons,
                 double radius, PairSum& pairs)
        : queries_(queries), query_(query), photons_(photons), radius_(radius), pairs_(pairs) {}

    bool addPoint(double, std::uint32_t photon) {
        if (is_within(queries_[query_], photons_[photon], radius_)) {
            pairs_.add(query_, photon);
        }
        return true;
    }
    double worstDist() const { return radius_ * radius_ * 1.0001; } // by which nanoflann prunes
    bool full() const { return true; }
    std::size_t size() const { return 0; }

private:
    const Positions& queries_;
    std::size_t query_;
    const Positions& photons_;
    double radius_;
    PairSum& pairs_;
};

TEST_F(SimultaneousSearch, SlowMillionByMillionOnASphere) {
    constexpr std::size_t count = 1'000'000;
    constexpr double radius = 0.01;
    const auto on_sphere = [&] {
        glm::vec3 p = in_cube();
        while (glm::dot(p, p) > 1 || glm::dot(p, p) < 1e-6f) {
            p = in_cube();
        }
        return glm::normalize(p);
    };
    store_photons(device(), positions(count, on_sphere));
    const Positions queries = positions(count, on_sphere);
    const Cloud cloud{photons_};
    const nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3,
                                              std::uint32_t>
        tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    PairSum expected;
    for (std::size_t i = 0; i < count; ++i) {
        PairsOfQuery pairs(queries, i, photons_, radius, expected);
        const glm::dvec3 query(queries[i]);
        tree.findNeighbors(pairs, &query.x, nanoflann::SearchParams());
    }
    // A disc is the share radius² / 4 of the sphere.
    EXPECT_RELATIVE(double(expected.number), 1e12 * radius * radius / 4, 0.01);
    EXPECT_EQ(search(device(), queries, radius, {}).within, expected);
}

} // namespace
} // namespace argand::testing
