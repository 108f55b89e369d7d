// The rules of the kd-tree, seen in trees that the host builds.
#include "accel/kdtrees.hpp"
#include "base/error.hpp"

#include <cmath>

namespace argand {
namespace {

using testing::box_between, testing::elements_of, testing::kinds_of_elements,
    testing::scattered_boxes;

vec3 low_of(const BoxRecord& b) { return {b.low_x, b.low_y, b.low_z}; }
vec3 high_of(const BoxRecord& b) { return {b.high_x, b.high_y, b.high_z}; }

/// What a walk over all words finds.
struct Walked {
    std::vector<std::vector<std::uint32_t>> leaves; ///< their elements, from left to right
    std::size_t parents = 0;
    std::size_t words = 0;
    std::size_t depth = 0;
};

/// Walks in depth-first order, and tests what each node says against the others.
void walk(const HostKdTree& tree, std::size_t depth, Walked& walked) {
    const auto address = static_cast<std::uint32_t>(walked.words);
    ASSERT_LT(address + 1, tree.words.size());
    const std::uint32_t first = tree.words[address];
    const std::uint32_t index = kd_node_index(first);
    ASSERT_LT(index, tree.boxes.size());
    EXPECT_EQ(tree.addresses[index], address);
    walked.depth = std::max(walked.depth, depth);
    if (kd_is_leaf(first)) {
        EXPECT_EQ(index, walked.leaves.size());
        const std::uint32_t count = tree.words[address + 1];
        ASSERT_LE(address + kd_leaf_words + count, tree.words.size());
        const auto begin = tree.words.begin() + address + kd_leaf_words;
        walked.leaves.emplace_back(begin, begin + count);
        walked.words += kd_leaf_words + count;
        return;
    }
    EXPECT_EQ(index, tree.leaf_count + walked.parents);
    ++walked.parents;
    walked.words += kd_parent_words;
    const std::uint32_t parent = tree.words[address + 1];
    const float split = bits_float(tree.words[address + 2]);
    const std::uint32_t axis = kd_axis(parent);
    ASSERT_LT(axis, 3u);
    EXPECT_EQ(kd_left_child(address), walked.words);
    const std::uint32_t left = kd_node_index(tree.words[walked.words]);
    walk(tree, depth + 1, walked);
    ASSERT_EQ(kd_right_child(parent), walked.words);
    const std::uint32_t right = kd_node_index(tree.words[walked.words]);
    // The children's cells are the two parts of the node's.
    const BoxRecord& box = tree.boxes[index];
    EXPECT_LT(kd_at(low_of(box), axis), split);
    EXPECT_GT(kd_at(high_of(box), axis), split);
    EXPECT_EQ(low_of(tree.boxes[left]), low_of(box));
    EXPECT_EQ(high_of(tree.boxes[left]), kd_with(high_of(box), axis, split));
    EXPECT_EQ(low_of(tree.boxes[right]), kd_with(low_of(box), axis, split));
    EXPECT_EQ(high_of(tree.boxes[right]), high_of(box));
    walk(tree, depth + 1, walked);
}

/// Tests that each leaf has just the elements that its half-open cell meets.
void expect_elements_in_their_leaves(const HostKdTree& tree, const Walked& walked,
                                     const std::vector<BoxRecord>& boxes) {
    for (std::size_t leaf = 0; leaf < walked.leaves.size(); ++leaf) {
        const vec3 low = low_of(tree.boxes[leaf]);
        const vec3 high = high_of(tree.boxes[leaf]);
        std::vector<std::uint32_t> expected;
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            const vec3 box_low = kd_position(low_of(boxes[i]));
            const vec3 box_high = max(box_low, kd_position(high_of(boxes[i])));
            if (glm::all(glm::lessThan(box_low, high)) &&
                glm::all(glm::greaterThanEqual(box_high, low))) {
                expected.push_back(i);
            }
        }
        ASSERT_EQ(walked.leaves[leaf], expected) << "leaf " << leaf;
    }
}

Walked expect_tree(const HostKdTree& tree, const std::vector<BoxRecord>& boxes) {
    Walked walked;
    walk(tree, 0, walked);
    EXPECT_EQ(walked.words, tree.words.size());
    EXPECT_EQ(walked.leaves.size(), tree.leaf_count);
    EXPECT_EQ(walked.parents + 1, tree.leaf_count);
    EXPECT_EQ(tree.boxes.size(), 2 * std::size_t(tree.leaf_count) - 1);
    EXPECT_EQ(tree.addresses.size(), tree.boxes.size());
    EXPECT_LE(walked.depth, kd_most_depth);
    expect_elements_in_their_leaves(tree, walked, boxes);
    return walked;
}

TEST(KdTree, ElementsAreInTheLeavesThatTheirBoxesMeet) {
    for (const std::string& kind : kinds_of_elements()) {
        for (const std::size_t count : {0u, 1u, 2u, 31u, 32u, 33u, 500u}) {
            SCOPED_TRACE(kind + ", " + std::to_string(count));
            const auto boxes = elements_of(kind, count);
            expect_tree(build_kdtree_on_host(boxes, {}), boxes);
        }
    }
}

TEST(KdTree, EachPointHasALeafOfItsOwn) {
    for (const std::string kind : {"points", "one point", "two points", "lattice"}) {
        for (const std::size_t count : {0u, 1u, 2u, 31u, 32u, 33u, 2000u}) {
            SCOPED_TRACE(kind + ", " + std::to_string(count));
            const auto boxes = elements_of(kind, count);
            const HostKdTree tree = build_kdtree_on_host(boxes, {.points = true});
            const Walked walked = expect_tree(tree, boxes);
            for (const auto& leaf : walked.leaves) {
                for (const std::uint32_t i : leaf) {
                    EXPECT_EQ(low_of(boxes[i]), low_of(boxes[leaf[0]])) << "not parted";
                }
            }
            // Points on planes, too, are found where they are. Many of a lattice are.
            for (std::uint32_t i = 0; i < count; ++i) {
                const auto& leaf = walked.leaves[leaf_of_point(tree, low_of(boxes[i]))];
                EXPECT_TRUE(std::ranges::binary_search(leaf, i));
            }
        }
    }
}

TEST(KdTree, LeavesOfPointsHoldAsManyAsWanted) {
    const auto boxes = elements_of("points", 3000);
    const HostKdTree tree = build_kdtree_on_host(boxes, {.points = true, .leaf_size = 8});
    const Walked walked = expect_tree(tree, boxes);
    EXPECT_LT(walked.leaves.size(), 3000u / 2);
    for (const auto& leaf : walked.leaves) {
        EXPECT_LE(leaf.size(), 8u);
    }
}

TEST(KdTree, WordsOfTwoPoints) {
    const std::vector<BoxRecord> boxes{box_between({1, 0, 0}, {1, 0, 0}),
                                       box_between({0, 0, 0}, {0, 0, 0})};
    const HostKdTree tree = build_kdtree_on_host(boxes, {.points = true});
    const std::vector<std::uint32_t> expected{
        2,           6,  0x3f800000u, // parent 2: axis 0, right child at 6, split at 1
        0x80000000u, 1u, 1u,          // leaf 0: point 1
        0x80000001u, 1u, 0u};         // leaf 1: point 0
    EXPECT_EQ(tree.words, expected);
    EXPECT_EQ(tree.addresses, (std::vector<std::uint32_t>{3, 6, 0}));
}

TEST(KdTree, APlaneEndsJustAboveAnElement) {
    // Two boxes far apart on z, each of which is cheaper to test alone.
    const std::vector<BoxRecord> boxes{box_between({0, 0, 0}, {1, 1, 1}),
                                       box_between({0, 0, 10}, {1, 1, 11})};
    const HostKdTree tree = build_kdtree_on_host(boxes, {});
    expect_tree(tree, boxes);
    ASSERT_GE(tree.leaf_count, 2u);
    EXPECT_EQ(kd_axis(tree.words[1]), 2u);
    const float split = bits_float(tree.words[2]);
    EXPECT_TRUE(split == std::nextafter(1.0f, 2.0f) || split == 10.0f);
}

TEST(KdTree, EmptySpaceIsCutOff) {
    // All elements are in a corner of the cell: no plane through the middle of the cell is needed.
    auto boxes = scattered_boxes(200, 0.01f);
    const BoxRecord cell = box_between({-100, -100, -100}, {0.5f, 900, 0.5f});
    const HostKdTree tree = build_kdtree_on_host(boxes, {}, &cell);
    const Walked walked = expect_tree(tree, boxes);
    EXPECT_EQ(low_of(tree.boxes[tree.leaf_count]), vec3(-100));
    EXPECT_EQ(high_of(tree.boxes[tree.leaf_count]).y, std::nextafter(900.0f, 1e9f));
    const std::uint32_t middle = leaf_of_point(tree, {0, 400, 0});
    EXPECT_TRUE(walked.leaves[middle].empty());
    float highest = 0;
    for (const BoxRecord& box : boxes) {
        highest = std::max(highest, box.high_y);
    }
    EXPECT_EQ(low_of(tree.boxes[middle]).y, std::nextafter(highest, 2.0f));
}

TEST(KdTree, TheTreeOfAnEmptySceneIsALeaf) {
    const HostKdTree tree = build_kdtree_on_host({}, {});
    EXPECT_EQ(tree.words, (std::vector<std::uint32_t>{kd_leaf, 0}));
    EXPECT_EQ(leaf_of_point(tree, {7, 8, 9}), 0u);
}

TEST(KdTree, ScaleDoesNotMatter) {
    for (const bool points : {false, true}) {
        const auto boxes = elements_of("boxes", 700);
        const HostKdTree tree = build_kdtree_on_host(boxes, {.points = points, .reach = 0.01f});
        for (const int power : {-70, 90}) {
            const float scale = std::ldexp(1.0f, power);
            auto scaled = boxes;
            for (BoxRecord& b : scaled) {
                b = box_between(low_of(b) * scale, high_of(b) * scale);
            }
            const HostKdTree other =
                build_kdtree_on_host(scaled, {.points = points, .reach = 0.01f * scale});
            EXPECT_EQ(other.addresses, tree.addresses);
            for (std::size_t i = 0; i < tree.boxes.size(); ++i) {
                ASSERT_EQ(low_of(other.boxes[i]), low_of(tree.boxes[i]) * scale) << power;
            }
        }
    }
}

TEST(KdTree, StopsAtItsMemory) {
    for (const std::string kind : {"boxes", "overlapping", "slivers"}) {
        const auto boxes = elements_of(kind, 1000);
        const HostKdTree whole = build_kdtree_on_host(boxes, {});
        EXPECT_FALSE(whole.stopped);
        const auto bytes = [](const HostKdTree& t) {
            return 4 * (t.words.size() + t.addresses.size()) + sizeof(BoxRecord) * t.boxes.size();
        };
        for (const std::uint64_t memory : {5000u, 20000u, 100000u}) {
            const HostKdTree tree = build_kdtree_on_host(boxes, {.memory = memory});
            expect_tree(tree, boxes);
            EXPECT_LE(bytes(tree), memory);
            EXPECT_EQ(tree.stopped, bytes(tree) < bytes(whole));
        }
    }
    // A leaf of 1,000 elements, its box and address.
    const auto boxes = elements_of("boxes", 1000);
    EXPECT_EQ(build_kdtree_on_host(boxes, {.memory = 4044}).leaf_count, 1u);
    try {
        build_kdtree_on_host(boxes, {.memory = 4043});
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "building a kd-tree: its memory of 4043 bytes does not hold one leaf of 1000 "
                     "elements, which takes 4044; allow more (--tree-memory)");
    }
}

TEST(KdTree, TestingOneLeafCostsFarLessThanTestingAll) {
    // What a random point costs: the elements of its leaf.
    const auto boxes = scattered_boxes(20000, 0.02f);
    const HostKdTree tree = build_kdtree_on_host(boxes, {});
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::size_t visited = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto leaf = leaf_of_point(tree, {uniform(random), uniform(random), uniform(random)});
        visited += tree.words[tree.addresses[leaf] + 1];
    }
    EXPECT_LT(visited, 1000u * 8u);
    EXPECT_LT(tree.words.size(), 20000u * 40u);
}

} // namespace
} // namespace argand
