// The device builds the tree that the host builds by the same rules.
#include "accel/kdtree.hpp"
#include "base/error.hpp"
#include "device_fixture.hpp"
#include "kdtrees.hpp"

#include <cstring>

namespace argand {
namespace {

HostKdTree built(Device& device, const std::vector<BoxRecord>& boxes,
                 const KdTreeSettings& settings) {
    return download_kdtree(device,
                           build_kdtree(device, upload(device, "boxes", boxes),
                                        static_cast<std::uint32_t>(boxes.size()), settings));
}

void expect_same(const HostKdTree& tree, const HostKdTree& expected) {
    EXPECT_EQ(tree.leaf_count, expected.leaf_count);
    EXPECT_EQ(tree.stopped, expected.stopped);
    EXPECT_EQ(tree.words, expected.words);
    EXPECT_EQ(tree.addresses, expected.addresses);
    ASSERT_EQ(tree.boxes.size(), expected.boxes.size());
    EXPECT_EQ(std::memcmp(tree.boxes.data(), expected.boxes.data(),
                          expected.boxes.size() * sizeof(BoxRecord)),
              0);
}

using KdTreeBuild = VariantTest;

TEST_P(KdTreeBuild, EqualsTheHosts) {
    Device& device = open_variant();
    for (const std::string& kind : kinds_of_elements()) {
        for (const std::size_t count : {0u, 1u, 2u, 31u, 32u, 33u, 1000u}) {
            SCOPED_TRACE(kind + ", " + std::to_string(count));
            const auto boxes = elements_of(kind, count);
            expect_same(built(device, boxes, {}), build_kdtree_on_host(boxes, {}));
        }
    }
}

TEST_P(KdTreeBuild, OfPointsEqualsTheHosts) {
    Device& device = open_variant();
    for (const std::string& kind : kinds_of_elements()) {
        for (const std::size_t count : {0u, 1u, 2u, 31u, 32u, 33u, 1000u}) {
            SCOPED_TRACE(kind + ", " + std::to_string(count));
            const auto boxes = elements_of(kind, count);
            for (const KdTreeSettings& settings :
                 {KdTreeSettings{.points = true},
                  KdTreeSettings{.points = true, .reach = 0.1f, .leaf_size = 8}}) {
                expect_same(built(device, boxes, settings), build_kdtree_on_host(boxes, settings));
            }
        }
    }
}

TEST_P(KdTreeBuild, StopsWhereTheHostStops) {
    Device& device = open_variant();
    for (const std::string kind : {"boxes", "overlapping", "slivers"}) {
        const auto boxes = elements_of(kind, 1000);
        for (const std::uint64_t memory : {4044u, 5000u, 20000u, 100000u}) {
            SCOPED_TRACE(kind + ", " + std::to_string(memory));
            expect_same(built(device, boxes, {.memory = memory}),
                        build_kdtree_on_host(boxes, {.memory = memory}));
        }
    }
    const auto boxes = elements_of("boxes", 1000);
    EXPECT_THROW(built(device, boxes, {.memory = 4043}), Error);
}

// All in one leaf, whose elements no loop of one invocation could write on lavapipe.
TEST_P(KdTreeBuild, WritesALeafOfManyElements) {
    Device& device = open_variant();
    const auto boxes = elements_of("one point", 70'000);
    const HostKdTree tree = built(device, boxes, {.points = true});
    expect_same(tree, build_kdtree_on_host(boxes, {.points = true}));
    EXPECT_EQ(tree.words[tree.addresses[leaf_of_point(tree, {3, 4, 5})] + 1], 70'000u);
}

using LargeKdTreeBuild = DeviceTest;

TEST_F(LargeKdTreeBuild, OfAMillionElementsEqualsTheHostsSlow) {
    Device& device = open();
    for (const bool points : {false, true}) {
        const auto boxes = scattered_boxes(1'000'000, 0.01f);
        // Not more leaves than lavapipe can address.
        const KdTreeSettings settings{.points = points, .leaf_size = points ? 1u : 4u};
        expect_same(built(device, boxes, settings), build_kdtree_on_host(boxes, settings));
    }
}

INSTANTIATE_VARIANTS(KdTreeBuild);

} // namespace
} // namespace argand
