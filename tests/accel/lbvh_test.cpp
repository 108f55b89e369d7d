#include "accel/lbvh.hpp"
#include "device_fixture.hpp"
#include "meshes.hpp"
#include "one_thread.hpp"
#include "serial_lbvh.hpp"

namespace argand {
namespace {

using LbvhBuild = VariantTest;

std::vector<BoxRecord> random_boxes(std::size_t count, float size, glm::vec3 scale = glm::vec3(1)) {
    std::mt19937 random(7);
    std::vector<BoxRecord> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 centre = random_point(random);
        const glm::vec3 half = glm::abs(random_point(random, size));
        const glm::vec3 low = scale * (centre - half);
        const glm::vec3 high = scale * (centre + half);
        boxes.push_back({low.x, low.y, low.z, 0, high.x, high.y, high.z, 0});
    }
    return boxes;
}

SerialLbvh build_on(Device& device, const std::vector<BoxRecord>& boxes, const Count& count,
                    std::size_t number) {
    const Lbvh bvh = build_lbvh(device, upload(device, "boxes", boxes), count);
    SerialLbvh result{download<std::uint32_t>(device, bvh.order, number),
                      download<LbvhNode>(device, bvh.nodes, 2 * number)};
    return result;
}

/// Node 2 n - 2, which would be inner node n - 1, does not exist.
void expect_same(const SerialLbvh& found, const SerialLbvh& expected) {
    ASSERT_EQ(found.order, expected.order);
    for (std::size_t i = 0; i < expected.nodes.size(); ++i) {
        const LbvhNode& a = found.nodes[i];
        const LbvhNode& b = expected.nodes[i];
        if (i + 2 == expected.nodes.size()) {
            continue;
        }
        ASSERT_TRUE(a.child == b.child && a.escape == b.escape) << i;
        ASSERT_TRUE(a.low_x == b.low_x && a.low_y == b.low_y && a.low_z == b.low_z) << i;
        ASSERT_TRUE(a.high_x == b.high_x && a.high_y == b.high_y && a.high_z == b.high_z) << i;
    }
}

void expect_serial(Device& device, const std::vector<BoxRecord>& boxes) {
    expect_same(build_on(device, boxes, boxes.size(), boxes.size()), build_serially(boxes));
}

TEST_P(LbvhBuild, IsTheSerialOne) {
    Device& device = open_variant();
    for (const std::size_t count : {1, 2, 3, 5, 8, 63, 64, 65, 1009, 30011}) {
        SCOPED_TRACE(count);
        expect_serial(device, random_boxes(count, 0.05f));
    }
}

TEST_P(LbvhBuild, OfNoBoxIsEmpty) {
    Device& device = open_variant();
    const Lbvh bvh = build_lbvh(device, upload(device, "boxes", std::vector<BoxRecord>{}), 0);
    device.wait();
    EXPECT_TRUE(bvh.nodes);
}

TEST_P(LbvhBuild, TakesTheCountFromTheDevice) {
    Device& device = open_variant();
    std::vector<BoxRecord> boxes = random_boxes(5000, 0.05f);
    for (const std::uint32_t count : {0u, 1u, 2u, 1777u, 5000u}) {
        SCOPED_TRACE(count);
        const Buffer counts = upload(device, "counts", std::vector<std::uint32_t>{99, count});
        const SerialLbvh found = build_on(device, boxes, Count(counts, 1, boxes.size()), count);
        expect_same(found, build_serially({boxes.begin(), boxes.begin() + count}));
    }
}

TEST_P(LbvhBuild, TellsEqualCodesApartByTheirPlace) {
    Device& device = open_variant();
    for (const std::size_t count : {2, 3, 100, 4096, 20000}) {
        SCOPED_TRACE(count);
        expect_serial(device, std::vector<BoxRecord>(count, {1, 2, 3, 0, 4, 5, 6, 0}));
        expect_serial(device, std::vector<BoxRecord>(count, {1, 2, 3, 0, 1, 2, 3, 0}));
    }
    // Runs of equal codes among others.
    std::vector<BoxRecord> boxes = random_boxes(3000, 0.01f);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        boxes[i] = boxes[i / 7 * 7];
    }
    expect_serial(device, boxes);
}

TEST_P(LbvhBuild, TakesFlatAndExtremeBoxes) {
    Device& device = open_variant();
    for (const glm::vec3 scale :
         {glm::vec3(1, 1, 0), glm::vec3(0, 1, 0), glm::vec3(1e6f), glm::vec3(1e-6f),
          glm::vec3(1e30f), glm::vec3(1e-30f, 1e30f, 1)}) {
        SCOPED_TRACE(scale.x);
        expect_serial(device, random_boxes(2000, 0.1f, scale));
    }
}

TEST_P(LbvhBuild, NodesHoldTheirChildrenAndNoMore) {
    Device& device = open_variant();
    const std::vector<BoxRecord> boxes = random_boxes(10007, 0.1f);
    const SerialLbvh bvh = build_on(device, boxes, boxes.size(), boxes.size());
    std::vector<int> seen(boxes.size());
    std::size_t nodes = 0;
    for (std::uint32_t i = 0; i != lbvh_end; ++nodes) {
        const LbvhNode& node = bvh.nodes[i];
        if ((i & 1) != 0) {
            ++seen[node.child];
            EXPECT_EQ(node.child, bvh.order[i >> 1]);
            i = node.escape;
            continue;
        }
        const LbvhNode& left = bvh.nodes[node.child];
        const LbvhNode& right = bvh.nodes[left.escape];
        EXPECT_EQ(right.escape, node.escape);
        EXPECT_EQ(node.low_x, std::min(left.low_x, right.low_x));
        EXPECT_EQ(node.high_z, std::max(left.high_z, right.high_z));
        i = node.child;
    }
    EXPECT_EQ(nodes, 2 * boxes.size() - 1);
    EXPECT_THAT(seen, testing::Each(1));
}

INSTANTIATE_VARIANTS(LbvhBuild);

using Lbvh1Thread = OneThreadTest;

TEST_F(Lbvh1Thread, BuildsWhatTwoBuild) {
    const std::vector<BoxRecord> boxes = random_boxes(20000, 0.02f);
    const SerialLbvh two = build_on(open_with_all_threads(), boxes, boxes.size(), boxes.size());
    expect_same(build_on(open_with_one_thread(), boxes, boxes.size(), boxes.size()), two);
}

} // namespace
} // namespace argand
