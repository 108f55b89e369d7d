// Trees by the voxel volume heuristic, and that estimates by them agree with those by the linear
// build.
#include "photon/map_queries.hpp"
#include "photon/photon_kdtree.hpp"
#include "photon/vvh.hpp"
#include "shared/footprint.h"
#include "shared/photon.h"
#include "world/world.hpp"

#include <algorithm>
#include <cstring>
#include <random>

namespace argand {
namespace {

using testing::answers, testing::Gathered, testing::Query, testing::store;

std::vector<BoxRecord> random_boxes(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    std::vector<BoxRecord> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 p =
            i % 5 == 0 ? glm::vec3(0.5f)
                       : glm::vec3(coordinate(random), coordinate(random), coordinate(random));
        const float size = 0.05f + 0.04f * coordinate(random);
        boxes.push_back(
            {p.x - size, p.y - size, p.z - size, 0, p.x + size, p.y + size, p.z + size, 0});
    }
    return boxes;
}

/// The leaves that a walk by escape references from the root meets if it enters every node.
struct Walked {
    std::vector<std::uint32_t> leaves;
    std::size_t nodes = 0;
};

Walked walk(const LaidOutTree& tree) {
    Walked walked;
    std::uint32_t node = tree.leaves.empty() ? lbvh_end : tree.leaves.size() == 1 ? 1u : 0u;
    while (node != lbvh_end && walked.nodes < 2 * tree.nodes.size()) {
        ++walked.nodes;
        const bool leaf = (node & 1u) != 0;
        if (leaf) {
            walked.leaves.push_back(tree.nodes[node].child);
        }
        node = leaf ? tree.nodes[node].escape : tree.nodes[node].child;
    }
    return walked;
}

bool holds(const LbvhNode& node, const BoxRecord& box) {
    return node.low_x <= box.low_x && node.low_y <= box.low_y && node.low_z <= box.low_z &&
           node.high_x >= box.high_x && node.high_y >= box.high_y && node.high_z >= box.high_z;
}

/// The tree by centres of boxes that the host builds.
VolumeTree kdtree_of(const std::vector<BoxRecord>& boxes, std::uint32_t leaf_size) {
    std::vector<BoxRecord> centres = boxes;
    for (BoxRecord& b : centres) {
        b.low_x = b.high_x = 0.5f * (b.low_x + b.high_x);
        b.low_y = b.high_y = 0.5f * (b.low_y + b.high_y);
        b.low_z = b.high_z = 0.5f * (b.low_z + b.high_z);
    }
    const HostKdTree tree = build_kdtree_on_host(centres, {.points = true, .leaf_size = leaf_size});
    return volume_tree_of(tree, boxes, leaf_size);
}

using BuildTree = VolumeTree (*)(const std::vector<BoxRecord>& boxes, std::uint32_t leaf_size);

void expect_leaves_part_the_boxes(BuildTree build) {
    for (const std::size_t count : {0u, 1u, 2u, 3u, 100u, 5000u}) {
        for (const std::uint32_t leaf_size : {1u, 4u, 512u}) {
            SCOPED_TRACE(::testing::Message() << count << " in leaves of " << leaf_size);
            const std::vector<BoxRecord> boxes = random_boxes(count, 1);
            const VolumeTree tree = build(boxes, leaf_size);
            std::vector<std::uint32_t> sorted = tree.order;
            std::sort(sorted.begin(), sorted.end());
            ASSERT_EQ(sorted.size(), count);
            for (std::uint32_t i = 0; i < count; ++i) {
                ASSERT_EQ(sorted[i], i);
            }
            const LaidOutTree laid_out = lay_out(tree, leaf_size);
            const Walked walked = walk(laid_out);
            ASSERT_EQ(walked.nodes, count == 0 ? 0 : 2 * laid_out.leaves.size() - 1);
            ASSERT_EQ(walked.leaves, laid_out.leaves);
            std::uint32_t next = 0;
            for (std::size_t i = 0; i < laid_out.leaves.size(); ++i) {
                const std::uint32_t first = laid_out.leaves[i] & leaf_first_mask;
                const std::uint32_t last = first + (laid_out.leaves[i] >> leaf_first_bits);
                ASSERT_EQ(first, next);
                ASSERT_LT(last - first, leaf_size);
                for (std::uint32_t k = first; k <= last; ++k) {
                    ASSERT_TRUE(holds(laid_out.nodes[2 * i + 1], boxes[tree.order[k]]));
                }
                next = last + 1;
            }
            ASSERT_EQ(next, count);
        }
    }
}

TEST(VolumeTree, LeavesPartTheBoxesAndBoxesHoldTheirs) {
    expect_leaves_part_the_boxes([](const std::vector<BoxRecord>& boxes, std::uint32_t leaf_size) {
        return build_volume_tree(boxes, leaf_size);
    });
}

TEST(VolumeTree, OfAKdTreePartsTheBoxes) { expect_leaves_part_the_boxes(kdtree_of); }

TEST(VolumeTree, FusedLeavesAreThoseOfATreeBuiltWithThem) {
    const std::vector<BoxRecord> boxes = random_boxes(3000, 2);
    const LaidOutTree fused = lay_out(build_volume_tree(boxes, 1), 16);
    const LaidOutTree built = lay_out(build_volume_tree(boxes, 16), 16);
    ASSERT_EQ(fused.leaves, built.leaves);
    ASSERT_EQ(
        std::memcmp(fused.nodes.data(), built.nodes.data(), built.nodes.size() * sizeof(LbvhNode)),
        0);
}

TEST(VolumeTree, RootIsSplitWhereTheCostIsLeast) {
    const std::vector<BoxRecord> boxes = random_boxes(60, 3);
    const VolumeTree tree = build_volume_tree(boxes, 1);
    const auto cost = [](const VolumeNode& a, const VolumeNode& b) {
        const auto term = [](const VolumeNode& n) {
            const BoxRecord& x = n.box;
            return double(x.high_x - x.low_x) * (x.high_y - x.low_y) * (x.high_z - x.low_z) *
                   n.count;
        };
        return term(a) + term(b);
    };
    const VolumeNode& root = tree.nodes[0];
    const double chosen = cost(tree.nodes[root.left], tree.nodes[root.right]);
    double least = chosen * 2;
    for (int axis = 0; axis < 3; ++axis) {
        const auto centre = [&](const BoxRecord& b) {
            return axis == 0   ? b.low_x + b.high_x
                   : axis == 1 ? b.low_y + b.high_y
                               : b.low_z + b.high_z;
        };
        std::vector<BoxRecord> sorted = boxes;
        std::stable_sort(sorted.begin(), sorted.end(), [&](const BoxRecord& a, const BoxRecord& b) {
            return centre(a) < centre(b);
        });
        const auto side = [&](std::size_t begin, std::size_t end) {
            VolumeNode node{
                .first = 0, .count = static_cast<std::uint32_t>(end - begin), .box = sorted[begin]};
            for (std::size_t i = begin; i < end; ++i) {
                const BoxRecord& b = sorted[i];
                node.box = {
                    std::min(node.box.low_x, b.low_x),   std::min(node.box.low_y, b.low_y),
                    std::min(node.box.low_z, b.low_z),   0,
                    std::max(node.box.high_x, b.high_x), std::max(node.box.high_y, b.high_y),
                    std::max(node.box.high_z, b.high_z), 0};
            }
            return node;
        };
        for (std::size_t i = 1; i < sorted.size(); ++i) {
            least = std::min(least, cost(side(0, i), side(i, sorted.size())));
        }
    }
    EXPECT_NEAR(chosen, least, 1e-5 * least);
}

TEST(VolumeTree, BoxesInOnePlaceMakeNoDeepTree) {
    const std::vector<BoxRecord> boxes(4096, BoxRecord{0, 0, 0, 0, 1, 1, 1, 0});
    const VolumeTree tree = build_volume_tree(boxes, 1);
    std::vector<int> depth(tree.nodes.size(), 0);
    int deepest = 0;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        deepest = std::max(deepest, depth[i]);
        if (tree.nodes[i].left != 0) {
            depth[tree.nodes[i].left] = depth[tree.nodes[i].right] = depth[i] + 1;
        }
    }
    EXPECT_EQ(deepest, 12);
}

/// The grey square |x|, |z| <= 1, facing up.
using VolumeHeuristicMap = VariantTest;

TEST_P(VolumeHeuristicMap, GathersWhatTheLinearBuildDoes) {
    Device& device = open_variant();
    const DeviceScene scene =
        upload_scene(device, testing::floor_scene(testing::lambertian(glm::vec3(0.5f)), 1),
                     make_plan({}, {.everything = true}));
    std::mt19937 random(4);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    constexpr std::size_t count = 20'000;
    std::vector<PhotonRecord> photons;
    std::vector<glm::uvec4> offsets;
    for (std::size_t i = 0; i < count; ++i) {
        const bool flat = i % 4 != 0;
        const glm::vec3 normal =
            flat ? glm::vec3(0, 1, 0) : glm::normalize(glm::vec3(0.3f * coordinate(random), 1, 0));
        photons.push_back({coordinate(random), 0, coordinate(random),
                           pack_photon_normal(normal, i % 3 == 0), 1 + coordinate(random), 1, 0.5f,
                           pack_unit({0, 1, 0})});
        const glm::vec3 u(0.04f + 0.03f * coordinate(random), 0, 0.03f * coordinate(random));
        const glm::uvec2 a = pack_dual(u);
        const glm::uvec2 b = pack_dual(glm::vec3(0.3f * u.z, 0, 0.05f));
        offsets.emplace_back(a.x, a.y, b.x, b.y);
    }
    PhotonWorkspace workspace =
        make_photon_workspace(device, count, {.extents = extents_differentials});
    const FootprintScale scale = make_footprint_scale(count, count, 1, {10, 1, 0.1f, 0.3f, 0.5f});
    const PhotonMap linear =
        build_photon_map(device, scene, workspace, store(device, workspace, photons, offsets),
                         {.area_samples = 1000, .leaf_size = 8, .footprints = scale});

    const std::vector<BoxRecord> boxes = footprint_boxes(device, linear);
    ASSERT_EQ(boxes.size(), count + 1000);
    const auto leaf_words = download<std::uint32_t>(
        device, linear.lbvh.order,
        download<std::uint32_t>(device, linear.counters, 1, counter_leaves)[0]);
    const auto nodes = download<LbvhNode>(device, linear.lbvh.nodes, 2 * leaf_words.size());
    for (std::size_t i = 0; i < leaf_words.size(); ++i) {
        const std::uint32_t first = leaf_words[i] & leaf_first_mask;
        float low = boxes[first].low_x;
        for (std::uint32_t k = first; k <= first + (leaf_words[i] >> leaf_first_bits); ++k) {
            low = std::min(low, boxes[k].low_x);
        }
        ASSERT_NEAR(nodes[2 * i + 1].low_x, low, 1e-5);
    }

    std::vector<Query> queries;
    for (int i = 0; i < 500; ++i) {
        queries.push_back({{coordinate(random), 0, coordinate(random)}});
    }
    const auto gather = [&](const PhotonMap& map) {
        bool finished = false;
        FootprintEstimator estimator(device, scene.plan);
        const std::vector<Gathered> sums =
            answers(device, estimator, map, queries, {.until_complete = false}, finished);
        EXPECT_TRUE(finished);
        return sums;
    };
    const std::vector<Gathered> expected = gather(linear);
    for (const VolumeTree& tree :
         {build_volume_tree(boxes, 1), build_photon_kdtree(device, boxes, 0.05f, 1)}) {
        const PhotonMap sorted = reordered(device, linear, tree.order);
        for (const std::uint32_t leaf_size : {1u, 32u, most_photons_a_leaf}) {
            SCOPED_TRACE(leaf_size);
            const std::vector<Gathered> found = gather(with_tree(device, sorted, tree, leaf_size));
            for (std::size_t i = 0; i < found.size(); ++i) {
                ASSERT_GT(expected[i].indirect.r, 0);
                ASSERT_NEAR(found[i].indirect.r, expected[i].indirect.r,
                            1e-4 * expected[i].indirect.r);
                ASSERT_NEAR(found[i].caustic.g, expected[i].caustic.g,
                            1e-4 * expected[i].caustic.g);
            }
        }
    }
}

INSTANTIATE_VARIANTS(VolumeHeuristicMap);

} // namespace
} // namespace argand
