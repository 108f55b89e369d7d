// The photons queue against a model on the host: what is in it, in which cells, and what estimates
// find there.
#include "photon/map_queries.hpp"
#include "photon/queue_kdtree.hpp"
#include "photon/queue_map.hpp"
#include "shared/photon.h"
#include "world/world.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace argand {
namespace {

using testing::answers, testing::Gathered, testing::Query;

constexpr float queue_radius = 0.3f;

class PhotonQueues : public DeviceTest {
protected:
    Device& device() { return open(); }

    PhotonRecord photon_at(glm::vec3 p, bool caustic = false) {
        std::uniform_real_distribution<float> flux(0.1f, 1);
        return {p.x,           p.y,
                p.z,           pack_photon_normal({0, 1, 0}, caustic),
                flux(random_), flux(random_),
                flux(random_), pack_unit(glm::normalize(glm::vec3(0.5f, 1, 0)))};
    }

    std::vector<PhotonRecord> random_photons(std::size_t count, bool caustics = false) {
        std::uniform_real_distribution<float> place(-1, 1);
        std::vector<PhotonRecord> photons;
        photons.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 p(place(random_), place(random_), place(random_));
            photons.push_back(photon_at(p, caustics && i % 3 == 0));
        }
        return photons;
    }

    /// Records with an empty slot behind each third of them, as tracing leaves them.
    QueueRecords upload_slots(const std::vector<PhotonRecord>& photons) {
        std::vector<PhotonRecord> slots(5); // others, before the first
        for (std::size_t i = 0; i < photons.size(); ++i) {
            slots.push_back(photons[i]);
            if (i % 3 == 0) {
                slots.push_back(photons[i]);
                slots.back().normal = no_photon;
            }
        }
        uploaded_ = upload(device(), "records", slots);
        return {uploaded_, 5, slots.size() - 5, photons.size()};
    }

    void divide(PhotonQueue& queue, const std::vector<PhotonRecord>& photons, bool caustics,
                double weight = 1) {
        divide_queue(device(), queue, {}, upload_slots(photons), weight, caustics);
    }

    void replace(PhotonQueue& queue, std::uint32_t block, std::uint32_t moment,
                 const std::vector<PhotonRecord>& photons) {
        replace_block(device(), queue, block, moment, upload_slots(photons));
    }

    /// The records in the queue, in its order.
    std::vector<PhotonRecord> records(const PhotonQueue& queue) {
        std::vector<PhotonRecord> found;
        if (queue.entries == 0) {
            return found;
        }
        const auto stored = download<PhotonRecord>(
            device(), queue.stored, queue.window * queue.block_room + queue.area_room);
        for (const std::uint32_t entry :
             download<std::uint32_t>(device(), queue.of_entry, queue.entries)) {
            found.push_back(stored[queue.blocks[entry >> queue_block_shift].first +
                                   (entry & queue_record_mask)]);
        }
        return found;
    }

    /// Expects these records, each in the cell whose half-open box it lies in.
    void expect_in_cells(const PhotonQueue& queue, const std::vector<PhotonRecord>& expected) {
        const std::vector<PhotonRecord> found = records(queue);
        ASSERT_EQ(found.size(), expected.size());
        const auto sorted = [](std::vector<PhotonRecord> r) {
            std::sort(r.begin(), r.end(), [](const PhotonRecord& a, const PhotonRecord& b) {
                return std::memcmp(&a, &b, sizeof a) < 0;
            });
            return r;
        };
        const auto a = sorted(found);
        const auto b = sorted(expected);
        ASSERT_TRUE(a.empty() ||
                    std::memcmp(a.data(), b.data(), a.size() * sizeof(PhotonRecord)) == 0);
        const auto starts = download<std::uint32_t>(device(), queue.starts, queue.cells + 1ull);
        std::vector<BoxRecord> boxes = boxes_of(queue.tree);
        ASSERT_EQ(boxes.size(), queue.tree.cells);
        for (std::uint32_t cell = 0; cell < queue.cells; ++cell) {
            const BoxRecord& box = boxes[cell % queue.tree.cells];
            for (std::uint32_t i = starts[cell]; i < starts[cell + 1]; ++i) {
                const PhotonRecord& p = found[i];
                ASSERT_TRUE(p.x >= box.low_x && p.x < box.high_x && p.y >= box.low_y &&
                            p.y < box.high_y && p.z >= box.low_z && p.z < box.high_z);
                ASSERT_EQ(photon_is_caustic(p.normal) && queue.caustic > 0,
                          cell >= queue.tree.cells);
            }
        }
        ASSERT_EQ(starts[queue.cells], expected.size());
    }

    /// The boxes of the cells, from the planes above each.
    static std::vector<BoxRecord> boxes_of(const CellTree& tree) {
        constexpr float end = std::numeric_limits<float>::infinity();
        std::vector<BoxRecord> of_nodes(tree.nodes.size());
        std::vector<BoxRecord> boxes(tree.cells);
        of_nodes[0] = {-end, -end, -end, 0, end, end, end, 0};
        for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
            const std::uint32_t axis = tree.nodes[i].link >> 30u;
            const std::uint32_t link = tree.nodes[i].link & 0x3fffffffu;
            if (axis == 3) {
                boxes[link] = of_nodes[i];
                continue;
            }
            of_nodes[i + 1] = of_nodes[link] = of_nodes[i];
            (&of_nodes[i + 1].high_x)[axis] = tree.nodes[i].split;
            (&of_nodes[link].low_x)[axis] = tree.nodes[i].split;
        }
        return boxes;
    }

    /// The radiance of a Lambertian surface over a ball, by hand, in double precision.
    static Gathered expected(const std::vector<PhotonRecord>& photons, const Query& query,
                             std::uint32_t part) {
        Gathered sum;
        for (const PhotonRecord& p : photons) {
            const bool caustic = photon_is_caustic(p.normal);
            const glm::dvec3 to = glm::dvec3(p.x, p.y, p.z) - glm::dvec3(query.position);
            if (glm::dot(to, to) < double(queue_radius) * queue_radius &&
                (part == map_whole || (part == map_caustic) == caustic)) {
                (caustic ? sum.caustic : sum.indirect) += glm::dvec3(p.flux_r, p.flux_g, p.flux_b);
            }
        }
        const double scale =
            0.5 / double(testing::pi) / (double(testing::pi) * queue_radius * queue_radius);
        return {sum.indirect * scale, sum.caustic * scale};
    }

    void expect_estimates(PhotonQueue& queue, const std::vector<PhotonRecord>& photons) {
        expect_estimates(map_of_queue(device(), queue, {}), photons, queue.caustic > 0);
    }

    /// has_caustic_part: whether caustic photons lie in a part of their own.
    void expect_estimates(const PhotonMap& map, const std::vector<PhotonRecord>& photons,
                          bool has_caustic_part) {
        const Plan plan = make_plan({}, {.everything = true});
        RadiusEstimator estimator(device(), plan, {queue_radius, queue_radius}, gather_budget,
                                  {.uniform_kernel = true, .ball = true});
        std::vector<Query> queries;
        std::uniform_real_distribution<float> place(-1, 1);
        for (int i = 0; i < 60; ++i) {
            queries.push_back({{place(random_), place(random_), place(random_)}});
        }
        for (const std::uint32_t part : {map_whole, map_indirect, map_caustic}) {
            if (part != map_whole && !has_caustic_part) {
                continue;
            }
            bool finished = false;
            const auto found = answers(device(), estimator, map, queries,
                                       {.until_complete = true, .part = part}, finished);
            for (std::size_t i = 0; i < queries.size(); ++i) {
                const Gathered e = expected(photons, queries[i], part);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(found[i].indirect[c], e.indirect[c], 1e-4 * e.indirect[c] + 1e-7);
                    EXPECT_NEAR(found[i].caustic[c], e.caustic[c], 1e-4 * e.caustic[c] + 1e-7);
                }
            }
        }
    }

    std::mt19937 random_{7};

private:
    Buffer uploaded_;
};

std::vector<PhotonRecord> concatenated(const std::vector<std::vector<PhotonRecord>>& blocks,
                                       const std::vector<PhotonRecord>& more = {}) {
    std::vector<PhotonRecord> all = more;
    for (const auto& block : blocks) {
        all.insert(all.end(), block.begin(), block.end());
    }
    return all;
}

TEST_F(PhotonQueues, HoldTheLastBlocksInTheCellsOfTheirPlaces) {
    for (const std::uint32_t window : {1u, 3u, 64u}) {
        for (const bool caustics : {false, true}) {
            SCOPED_TRACE(::testing::Message() << window << caustics);
            PhotonQueue queue = make_photon_queue(window, 4);
            divide(queue, random_photons(300), caustics);
            const std::vector<PhotonRecord> areas = random_photons(70);
            replace(queue, window, queue_always, areas);
            std::vector<std::vector<PhotonRecord>> blocks(window);
            for (std::uint32_t i = 0; i < 2 * window + 3; ++i) {
                std::vector<PhotonRecord> photons = random_photons(i % 5 * 40, caustics);
                // On planes between cells, and beyond all of them.
                const std::vector<BoxRecord> boxes = boxes_of(queue.tree);
                for (const BoxRecord& box : boxes) {
                    if (i % 4 == 0 && std::isfinite(box.low_x) && std::isfinite(box.high_y)) {
                        photons.push_back(photon_at({box.low_x, box.high_y, 5}));
                    }
                }
                blocks[i % window] = photons;
                replace(queue, i % window, i + 1, photons);
            }
            expect_in_cells(queue, concatenated(blocks, areas));
            divide_queue_anew(device(), queue, {});
            expect_in_cells(queue, concatenated(blocks, areas));
        }
    }
}

TEST_F(PhotonQueues, OldPhotonsOfACellLieBeforeNewOnes) {
    PhotonQueue queue = make_photon_queue(3, 1000);
    divide(queue, random_photons(10), false); // one cell
    ASSERT_EQ(queue.cells, 1u);
    for (std::uint32_t i = 0; i < 5; ++i) {
        replace(queue, i % 3, i + 1, random_photons(4));
    }
    const auto entries = download<std::uint32_t>(device(), queue.of_entry, queue.entries);
    std::vector<std::uint32_t> blocks;
    for (const std::uint32_t entry : entries) {
        blocks.push_back(entry >> queue_block_shift);
    }
    EXPECT_EQ(blocks, (std::vector<std::uint32_t>{2, 2, 2, 2, 0, 0, 0, 0, 1, 1, 1, 1}));
}

TEST_F(PhotonQueues, EstimatesFindThePhotonsOfAllBlocks) {
    for (const bool caustics : {false, true}) {
        PhotonQueue queue = make_photon_queue(4, 8);
        divide(queue, random_photons(200), caustics, 4);
        std::vector<std::vector<PhotonRecord>> blocks(4);
        for (std::uint32_t i = 0; i < 7; ++i) {
            blocks[i % 4] = random_photons(500, caustics);
            replace(queue, i % 4, i + 1, blocks[i % 4]);
            queue.blocks[i % 4].weight = 0.25f;
        }
        std::vector<PhotonRecord> all = concatenated(blocks);
        for (PhotonRecord& p : all) {
            p.flux_r *= 0.25f;
            p.flux_g *= 0.25f;
            p.flux_b *= 0.25f;
        }
        expect_estimates(queue, all);
    }
}

TEST_F(PhotonQueues, CellsThatTestAllPhotonsListThoseThatDescend) {
    for (const bool caustics : {false, true}) {
        PhotonQueue found = make_photon_queue(3, 100);
        found.leaves_test = true;
        PhotonQueue expected = make_photon_queue(3, 100);
        const std::vector<PhotonRecord> first = random_photons(20'000, caustics);
        divide(found, first, caustics);
        divide(expected, first, caustics);
        // More than a cell tests in one dispatch, a few, one and none.
        for (std::uint32_t i = 0; const std::size_t count : {20'000u, 3u, 1u, 0u, 700u}) {
            std::vector<PhotonRecord> photons = random_photons(count, caustics);
            for (const BoxRecord& box : boxes_of(expected.tree)) { // on planes between cells
                if (count == 700 && std::isfinite(box.low_x) && std::isfinite(box.high_y)) {
                    photons.push_back(photon_at({box.low_x, box.high_y, 0.5f}));
                }
            }
            replace(found, i % 3, i + 1, photons);
            replace(expected, i % 3, i + 1, photons);
            ++i;
            ASSERT_EQ(found.entries, expected.entries);
            const auto words = [&](const Buffer& buffer, std::uint64_t size) {
                return download<std::uint32_t>(device(), buffer, size);
            };
            EXPECT_EQ(words(found.of_entry, found.entries),
                      words(expected.of_entry, found.entries));
            EXPECT_EQ(words(found.cell_of_entry, found.entries),
                      words(expected.cell_of_entry, found.entries));
            EXPECT_EQ(words(found.starts, found.cells + 1ull),
                      words(expected.starts, found.cells + 1ull));
        }
    }
}

TEST_F(PhotonQueues, LeavesOfTheirOwnKdTreeHoldAllPhotons) {
    std::vector<PhotonRecord> in_one_place;
    for (int i = 0; i < 1'500; ++i) {
        in_one_place.push_back(photon_at({0.25f, 0.5f, -0.25f}, i % 2 == 0));
    }
    for (const bool caustics : {false, true}) {
        for (const std::uint32_t leaf_size : {1u, 16u}) {
            std::vector<std::vector<PhotonRecord>> sets{in_one_place};
            for (const std::size_t count : {0u, 1u, 2u, 31u, 33u, 3'000u}) {
                sets.push_back(random_photons(count, caustics));
            }
            for (const std::vector<PhotonRecord>& photons : sets) {
                SCOPED_TRACE(::testing::Message() << photons.size() << caustics << leaf_size);
                PhotonWorkspace workspace = make_photon_workspace(device(), photons.size());
                if (!photons.empty()) {
                    device().upload(workspace.photons, 0, std::as_bytes(std::span(photons)));
                }
                PhotonQueue queue =
                    sort_by_kdtree(device(), workspace, photons.size(), 0.1, leaf_size, caustics);
                EXPECT_EQ(queue.entries, photons.size());
                const PhotonMap map = map_of_queue(device(), queue, {});
                expect_estimates(map, photons, caustics);
            }
        }
    }
}

TEST_F(PhotonQueues, EstimatesFindAllOfCellsThatCannotBeDivided) {
    for (const bool caustics : {false, true}) {
        std::vector<PhotonRecord> photons = random_photons(50, caustics);
        for (int i = 0; i < 100'000; ++i) {
            photons.push_back(photon_at({0.25f, 0.5f, -0.25f}, caustics && i % 2 == 0));
        }
        PhotonQueue queue = make_photon_queue(1, 16);
        divide(queue, photons, caustics);
        replace(queue, 0, 1, photons);
        queue.blocks[0].weight = 1;
        expect_estimates(queue, photons);
        // And of one cell that holds all.
        queue = make_photon_queue(1, 1 << 20);
        divide(queue, photons, caustics);
        replace(queue, 0, 1, photons);
        queue.blocks[0].weight = 1;
        expect_estimates(queue, photons);
    }
}

TEST_F(PhotonQueues, NothingReadsPhotonsThatWereDropped) {
    PhotonQueue queue = make_photon_queue(2, 8);
    const std::vector<PhotonRecord> first = random_photons(400), second = random_photons(300);
    divide(queue, first, false, 2);
    replace(queue, 0, 1, first);
    replace(queue, 1, 2, second);
    replace(queue, 0, 3, {});
    queue.blocks[1].weight = 1;
    const std::vector<float> poison(queue.block_room * sizeof(PhotonRecord) / 4,
                                    std::numeric_limits<float>::quiet_NaN());
    device().upload(queue.stored, 0, std::as_bytes(std::span(poison)));
    expect_in_cells(queue, second);
    expect_estimates(queue, second);
    replace(queue, 1, 4, {});
    expect_estimates(queue, {});
}

TEST_F(PhotonQueues, EmptiedCellsCountTheBlocksTracedSince) {
    PhotonQueue queue = make_photon_queue(2, 8);
    const std::vector<PhotonRecord> first = random_photons(2'000), second = random_photons(2'000);
    divide(queue, first, false, 2);
    replace(queue, 0, 1, first);
    empty_near(device(), queue, {{-2, -2, -2, 0, 0, 2, 2, 0}}, 0.01, 1); // x < 0
    replace(queue, 1, 2, second);
    queue.blocks[0].weight = queue.blocks[1].weight = 0.5f;
    const PhotonMap map = map_of_queue(device(), queue, {});
    std::size_t of_first = 0;
    for (const PhotonRecord& p : first) {
        of_first += p.x < 0 ? 1 : 0;
    }
    const auto found = download<PhotonRecord>(device(), map.photons, queue.entries);
    double left = 0, right = 0, left_expected = 0, right_expected = 0;
    for (const PhotonRecord& p : found) {
        (p.x < 0 ? left : right) += p.flux_r;
    }
    for (const PhotonRecord& p : second) {
        (p.x < 0 ? left_expected : right_expected) += (p.x < 0 ? 1 : 0.5) * p.flux_r;
    }
    for (const PhotonRecord& p : first) {
        right_expected += p.x < 0 ? 0 : 0.5 * p.flux_r;
    }
    EXPECT_GT(of_first, 500u);
    // Cells reach across x = 0, and those are emptied as a whole.
    EXPECT_NEAR(left, left_expected, 0.01 * left_expected);
    EXPECT_NEAR(right, right_expected, 0.1 * right_expected);
    EXPECT_LT(found.size(), 4'000u - of_first + 1);
}

TEST_F(PhotonQueues, PhotonsHaveTheWeightsOfTheirLights) {
    PhotonQueue queue = make_photon_queue(2, 8);
    queue.lights = 2;
    const std::vector<PhotonRecord> photons = random_photons(900);
    divide(queue, photons, false, 2);
    std::vector<std::uint32_t> lights; // of slots, as upload_slots() makes them: by the place
    QueueRecords records = upload_slots(photons);
    for (const PhotonRecord& slot :
         download<PhotonRecord>(device(), records.photons, records.first + records.slots)) {
        lights.push_back(slot.x < 0 ? 0 : 1);
    }
    records.lights = upload(device(), "lights", lights);
    replace_block(device(), queue, 0, 1, records);
    replace_block(device(), queue, 1, 2, records);
    queue.light_weights = {0.25f, 1, 0.75f, 0}; // of block 0, and of block 1
    const auto sum = [&](const std::vector<PhotonRecord>& of, bool left) {
        double flux = 0;
        for (const PhotonRecord& p : of) {
            flux += (p.x < 0) == left ? double(p.flux_g) : 0;
        }
        return flux;
    };
    for (const bool emptied : {false, true}) {
        const PhotonMap map = map_of_queue(device(), queue, {});
        const auto found = download<PhotonRecord>(device(), map.photons, queue.entries);
        // Where block 0 is dropped, what is left has all the weight: of the light on the right it
        // is 0.
        EXPECT_NEAR(sum(found, true), sum(photons, true), 1e-4 * sum(photons, true));
        EXPECT_NEAR(sum(found, false), emptied ? 0 : sum(photons, false),
                    1e-4 * sum(photons, false));
        empty_near(device(), queue, {{-2, -2, -2, 0, 2, 2, 2, 0}}, 0.01, 1);
        replace_block(device(), queue, 1, 3, records);
    }
}

TEST_F(PhotonQueues, SlowAThousandFramesTakeNoMoreMemoryThanTen) {
    PhotonQueue queue = make_photon_queue(4, 8);
    const std::vector<PhotonRecord> photons = random_photons(50);
    divide(queue, photons, false, 4);
    std::uint64_t memory = 0;
    for (std::uint32_t i = 0; i < 1'000; ++i) {
        replace(queue, i % 4, i + 1, photons);
        map_of_queue(device(), queue, {});
        if (i == 10) {
            memory = device().memory().current;
        }
    }
    EXPECT_LE(device().memory().current, memory);
    EXPECT_EQ(queue.entries, 200u);
}

TEST(CellTree, HasThePlanesItIsGivenWhereThereAreManyPoints) {
    // x < 0 and, on its right, y < 0.5.
    const std::vector<CellNode> planes{
        {2, 0}, {3u << 30, 0}, {(1u << 30) | 4, 0.5f}, {3u << 30, 0}, {3u << 30, 0}};
    std::vector<glm::vec4> points;
    for (int i = 0; i < 40; ++i) {
        points.emplace_back(i < 20 ? -1 : 1, i % 2 == 0 ? 0 : 1, 0, 0.5f);
    }
    EXPECT_EQ(divide_cells(planes, points, 20, 1).cells, 1u);
    EXPECT_EQ(divide_cells(planes, points, 19, 1).cells, 2u);
    const CellTree tree = divide_cells(planes, points, 5, 1);
    EXPECT_EQ(tree.cells, 4u);
    EXPECT_EQ(tree.nodes[0].split, 0.0f);
    EXPECT_EQ(cell_of(tree, {1, 0.49f, 0}), 2u);
    EXPECT_EQ(cell_of(tree, {1, 0.5f, 0}), 3u);
    EXPECT_EQ(cell_of(tree, {-1, 0, 0}), 0u);
    EXPECT_EQ(divide_cells({}, {}, 5, 2).cells, 2u);
}

} // namespace
} // namespace argand
