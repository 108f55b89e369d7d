// The tree over stored photons, and who owns a map's data.
#include "device_fixture.hpp"
#include "photon/map_queries.hpp"
#include "photon/photon_map.hpp"
#include "shared/accel_records.h"
#include "shared/footprint.h"
#include "shared/photon.h"

#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <random>

namespace argand {
namespace {

struct Leaf {
    std::uint32_t first, count;
    bool operator==(const Leaf&) const = default;
};

/// Appends the leaves of at most leaf_size photons of the tree that splits photons first..last at
/// the highest bit in which their codes differ, or in which their places do if the codes are equal.
void split(const std::vector<std::uint64_t>& codes, std::uint32_t first, std::uint32_t last,
           std::uint32_t leaf_size, std::vector<Leaf>& leaves) {
    if (last - first < leaf_size) {
        leaves.push_back({first, last - first + 1});
        return;
    }
    const std::uint64_t differ = codes[first] ^ codes[last];
    const auto key = [&](std::uint32_t i) { return differ != 0 ? codes[i] : i; };
    const int bit = 63 - std::countl_zero(key(first) ^ key(last));
    std::uint32_t right = first + 1;
    while (key(right) >> bit == key(first) >> bit) {
        ++right;
    }
    split(codes, first, right - 1, leaf_size, leaves);
    split(codes, right, last, leaf_size, leaves);
}

/// A scene without triangles in the unit ball.
DeviceScene unit_ball(Device& device) {
    DeviceScene scene;
    scene.record.radius = 1;
    scene.scene = upload(device, "scene", std::vector<SceneRecord>{scene.record});
    return scene;
}

using PhotonMapTree = VariantTest;

std::vector<std::uint64_t> codes_of(Device& device, const PhotonWorkspace& workspace,
                                    std::size_t count, bool wide) {
    const auto words = download<std::uint32_t>(device, workspace.codes, wide ? 2 * count : count);
    std::vector<std::uint64_t> codes;
    for (std::size_t i = 0; i < count; ++i) {
        codes.push_back(wide ? std::uint64_t(words[2 * i + 1]) << 32 | words[2 * i] : words[i]);
    }
    return codes;
}

TEST_P(PhotonMapTree, LeavesAreTheLargestSubtreesBelowTheThreshold) {
    Device& device = open_variant();
    const DeviceScene scene = unit_ball(device);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> coordinate(-0.5f, 0.5f);
    for (const std::size_t count : {0u, 1u, 2u, 3u, 65u, 4001u, 100'003u}) {
        for (const std::uint32_t leaf_size : {1u, 2u, 16u, most_photons_a_leaf}) {
            const bool wide = leaf_size == 2 || leaf_size == 16;
            SCOPED_TRACE(::testing::Message() << count << " in leaves of " << leaf_size);
            std::vector<PhotonRecord> photons(count);
            std::size_t stored = 0;
            for (std::size_t i = 0; i < count; ++i) {
                PhotonRecord& p = photons[i];
                p.x = coordinate(random);
                p.y = coordinate(random);
                // Every seventh slot is empty, and every third photon lies at one point.
                p.normal = i % 7 == 3 ? no_photon : 0;
                if (i % 3 == 0) {
                    p.x = p.y = 0.25f;
                }
                stored += p.normal != no_photon ? 1 : 0;
            }
            PhotonWorkspace workspace = make_photon_workspace(device, count);
            device.upload(workspace.photons, 0, std::as_bytes(std::span(photons)));
            std::vector<std::uint32_t> counters(counter_count, 0);
            counters[counter_stored_slots] = static_cast<std::uint32_t>(count);
            device.upload(workspace.counters, 0, std::as_bytes(std::span(counters)));
            const PhotonMap map = build_photon_map(device, scene, workspace, {count, stored},
                                                   {.leaf_size = leaf_size, .wide_codes = wide});

            counters = download<std::uint32_t>(device, map.counters, counter_count);
            ASSERT_EQ(counters[counter_stored], stored);
            std::vector<Leaf> found;
            for (const std::uint32_t leaf :
                 download<std::uint32_t>(device, map.lbvh.order, counters[counter_leaves])) {
                found.push_back({leaf & leaf_first_mask, (leaf >> leaf_first_bits) + 1});
            }
            const std::vector<std::uint64_t> codes = codes_of(device, workspace, stored, wide);
            ASSERT_TRUE(std::is_sorted(codes.begin(), codes.end()));
            std::vector<Leaf> expected;
            if (stored > 0) {
                split(codes, 0, static_cast<std::uint32_t>(stored - 1), leaf_size, expected);
            }
            ASSERT_EQ(found, expected);

            const auto sorted = download<PhotonRecord>(device, map.photons, stored);
            const auto nodes = download<LbvhNode>(device, map.lbvh.nodes, 2 * found.size());
            for (std::size_t i = 0; i < found.size(); ++i) {
                const LbvhNode& node = nodes[2 * i + 1];
                float low = 1;
                float high = -1;
                for (std::uint32_t k = 0; k < found[i].count; ++k) {
                    low = std::min(low, sorted[found[i].first + k].x);
                    high = std::max(high, sorted[found[i].first + k].x);
                }
                ASSERT_EQ(node.low_x, low);
                ASSERT_EQ(node.high_x, high);
            }
        }
    }
}

// Codes span the cube around the photons: a large scene, whose parts far away hold area samples at
// most, does not make leaves larger.
TEST_P(PhotonMapTree, LeavesAreAsSmallInALargeScene) {
    Device& device = open_variant();
    std::mt19937 random(4);
    std::uniform_real_distribution<float> coordinate(-0.5f, 0.5f);
    std::vector<PhotonRecord> photons(10'000);
    for (PhotonRecord& p : photons) {
        p.x = coordinate(random);
        p.y = coordinate(random);
    }
    std::vector<double> areas;
    for (const float radius : {1.0f, 10'000.0f}) {
        DeviceScene scene = unit_ball(device);
        scene.record.radius = radius;
        scene.scene = upload(device, "scene", std::vector<SceneRecord>{scene.record});
        PhotonWorkspace workspace = make_photon_workspace(device, photons.size());
        const PhotonMap map = build_photon_map(device, scene, workspace,
                                               testing::store(device, workspace, photons), {});
        const auto leaves =
            download<std::uint32_t>(device, map.counters, counter_count)[counter_leaves];
        double area = 0;
        const auto nodes = download<LbvhNode>(device, map.lbvh.nodes, 2 * leaves);
        for (std::size_t i = 0; i < leaves; ++i) {
            const LbvhNode& node = nodes[2 * i + 1];
            area += double(node.high_x - node.low_x) * double(node.high_y - node.low_y);
        }
        areas.push_back(area);
    }
    EXPECT_EQ(areas[0], areas[1]);
    EXPECT_LT(areas[0], 1); // of the square in which the photons lie
}

/// Everything that a map consists of on the device.
std::vector<std::vector<std::uint32_t>> contents(Device& device, const PhotonMap& map) {
    const auto counters = download<std::uint32_t>(device, map.counters, counter_count);
    const std::uint32_t stored = counters[counter_stored];
    const std::uint32_t leaves = counters[counter_leaves];
    return {counters, download<std::uint32_t>(device, map.photons, stored * 8),
            download<std::uint32_t>(device, map.footprints, stored * 4),
            download<std::uint32_t>(device, map.lbvh.nodes, leaves * 16),
            download<std::uint32_t>(device, map.lbvh.order, leaves)};
}

// A map owns its data: later use of the workspace and of scratch memory does not change it. Only
// maps in use take memory.
TEST_P(PhotonMapTree, AMapStaysAsItIsWhenAnotherIsBuilt) {
    Device& device = open_variant();
    const DeviceScene scene = unit_ball(device);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> coordinate(-0.5f, 0.5f);
    const auto photons = [&](std::size_t count) {
        std::vector<PhotonRecord> some(count);
        for (PhotonRecord& p : some) {
            p = {coordinate(random), coordinate(random), coordinate(random)};
            p.normal = pack_photon_normal({0, 1, 0}, coordinate(random) > 0.3f);
        }
        return some;
    };
    constexpr std::size_t count = 3000;
    const uvec2 axis = pack_dual({0.01f, 0, 0});
    const uvec2 other_axis = pack_dual({0, 0, 0.02f});
    const std::vector<glm::uvec4> offsets(count, {axis.x, axis.y, other_axis.x, other_axis.y});
    PhotonWorkspace workspace =
        make_photon_workspace(device, count, {.extents = extents_differentials});
    PhotonMapSettings settings{.leaf_size = 8};
    settings.footprints = make_footprint_scale(count, count, 1, {10, 1, 0.1f, 0.3f, 0.5f});
    const auto build = [&](std::size_t some) {
        return build_photon_map(device, scene, workspace,
                                testing::store(device, workspace, photons(some), offsets),
                                settings);
    };
    const auto sorted_bytes = [&] {
        device.wait();
        return device.memory_by_name().at("photons, sorted").current;
    };
    std::optional<PhotonMap> first = build(count);
    const std::uint64_t bytes_of_one = sorted_bytes();
    const auto before = contents(device, *first);
    ASSERT_GT(before[4].size(), 300u);

    settings.leaf_size = 3;
    std::optional<PhotonMap> second = build(count - 100);
    const auto of_second = contents(device, *second);
    for (const auto& [name, memory] : std::map(device.memory_by_name())) {
        if (name != "photons, sorted") {
            device.fill(device.scratch(name, 16), 0x55555555u);
        }
    }
    for (const Buffer& buffer : {workspace.photons, workspace.offsets, workspace.counters,
                                 workspace.codes, workspace.order, workspace.heads}) {
        device.fill(buffer, 0x55555555u);
    }
    EXPECT_EQ(contents(device, *first), before);
    EXPECT_EQ(contents(device, *second), of_second);
    EXPECT_NE(before, of_second);
    EXPECT_EQ(sorted_bytes(), 2 * bytes_of_one);

    first.reset();
    second.reset();
    for (int i = 0; i < 3; ++i) {
        const PhotonMap map = build(count);
        EXPECT_EQ(sorted_bytes(), bytes_of_one);
    }
}

INSTANTIATE_VARIANTS(PhotonMapTree);

} // namespace
} // namespace argand
