// The tree over stored photons: its leaves.
#include "device_fixture.hpp"
#include "photon/photon_map.hpp"
#include "shared/accel_records.h"
#include "shared/photon.h"

#include <algorithm>
#include <bit>
#include <random>

namespace argand {
namespace {

struct Leaf {
    std::uint32_t first, count;
    bool operator==(const Leaf&) const = default;
};

/// Leaves of at most leaf_size photons of the tree that splits photons first..last at the highest
/// bit in which their codes differ, or their places if the codes are equal.
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
            SCOPED_TRACE(testing::Message() << count << " in leaves of " << leaf_size);
            std::vector<PhotonRecord> photons(count);
            std::size_t stored = 0;
            for (std::size_t i = 0; i < count; ++i) {
                PhotonRecord& p = photons[i];
                p.x = coordinate(random);
                p.y = coordinate(random);
                // Every seventh slot is empty, and every third photon lies in one point.
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

INSTANTIATE_VARIANTS(PhotonMapTree);

} // namespace
} // namespace argand
