// Paths of the queue's photons against boxes, by hand in double precision.
#include "photon/queue_paths.hpp"

#include "device_fixture.hpp"
#include "photon/queue_map.hpp"
#include "shared/photon.h"

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <random>

namespace argand {
namespace {

/// A photon with the vertices of its path: light, first hit, its own place.
struct Path {
    std::array<glm::dvec3, 3> at;
    PhotonRecord photon{};
};

class QueuePaths : public DeviceTest {
protected:
    Device& device() { return open(); }

    std::vector<Path> random_paths(std::size_t count, double extent = 1) {
        std::uniform_real_distribution<float> place(-1, 1);
        std::vector<Path> paths(count);
        for (Path& path : paths) {
            for (glm::dvec3& p : path.at) {
                // Rounded, as records hold it.
                p = glm::vec3(place(random_), place(random_), place(random_)) *
                    static_cast<float>(extent);
            }
            const glm::vec3 p(path.at[2]);
            path.photon = {p.x, p.y, p.z, pack_photon_normal({0, 1, 0}, false), 1, 1, 1, 0};
        }
        return paths;
    }

    /// Adds a block of these, each behind an empty slot.
    void replace(PhotonQueue& queue, std::uint32_t block, std::uint32_t moment,
                 const std::vector<Path>& paths) {
        std::vector<PhotonRecord> slots;
        std::vector<PathVertex> vertices(2 * paths.size());
        const auto vertex = [](const glm::dvec3& p, std::size_t previous) {
            const glm::vec3 q(p);
            return PathVertex{q.x, q.y, q.z, static_cast<std::uint32_t>(previous)};
        };
        for (std::size_t i = 0; i < paths.size(); ++i) {
            vertices[2 * i] = vertex(paths[i].at[0], no_vertex);
            vertices[2 * i + 1] = vertex(paths[i].at[1], 2 * i);
            slots.push_back({});
            slots.back().normal = no_photon;
            slots.push_back(paths[i].photon);
            vertices.push_back({});
            vertices.push_back(vertex(paths[i].at[2], 2 * i + 1));
        }
        const Buffer photons = upload(device(), "records", slots);
        const QueueRecords records{.photons = photons,
                                   .slots = slots.size(),
                                   .records = paths.size(),
                                   .vertices = upload(device(), "vertices", vertices),
                                   .paths = paths.size()};
        if (queue.cells == 0) {
            divide_queue(device(), queue, {}, records, 1, false);
        }
        replace_block(device(), queue, block, moment, records);
    }

    static bool is_crossed(const BoxRecord& box, const glm::dvec3& from, const glm::dvec3& to,
                           double by) {
        double first = 0, last = 1;
        const glm::dvec3 low = glm::dvec3(box.low_x, box.low_y, box.low_z) - by;
        const glm::dvec3 high = glm::dvec3(box.high_x, box.high_y, box.high_z) + by;
        for (int i = 0; i < 3; ++i) {
            const double d = to[i] - from[i];
            if (d == 0) {
                first = from[i] < low[i] || from[i] > high[i] ? 2 : first;
                continue;
            }
            const double a = (low[i] - from[i]) / d, b = (high[i] - from[i]) / d;
            first = std::max(first, std::min(a, b));
            last = std::min(last, std::max(a, b));
        }
        return first <= last;
    }

    static bool is_crossed(const BoxRecord& box, const Path& path, double by) {
        return is_crossed(box, path.at[0], path.at[1], by) ||
               is_crossed(box, path.at[1], path.at[2], by);
    }

    /// What is kept of each photon, in the order of the queue.
    std::vector<std::uint32_t> crossed(const PhotonQueue& queue) {
        std::vector<std::uint32_t> found;
        const auto ends =
            download<QueuePathEnd>(device(), queue.path_ends, queue.window * queue.block_room);
        for (const std::uint32_t entry :
             download<std::uint32_t>(device(), queue.of_entry, queue.entries)) {
            found.push_back(
                ends[queue.blocks[entry >> queue_block_shift].first + (entry & queue_record_mask)]
                    .crossed);
        }
        return found;
    }

    /// The index of each of the queue's photons among these, which lie in different places.
    std::vector<std::size_t> order(const PhotonQueue& queue, const std::vector<Path>& paths) {
        std::vector<std::size_t> found;
        const auto map = map_of(queue);
        for (const PhotonRecord& p : map) {
            std::size_t i = 0;
            while (i < paths.size() && !(paths[i].photon.x == p.x && paths[i].photon.y == p.y)) {
                ++i;
            }
            found.push_back(i);
        }
        return found;
    }

    std::vector<PhotonRecord> map_of(PhotonQueue queue) {
        const PhotonMap map = map_of_queue(device(), queue, {});
        return download<PhotonRecord>(device(), map.photons, queue.entries);
    }

    static PhotonQueue queue_of(std::uint32_t window) {
        PhotonQueue queue = make_photon_queue(window, 8);
        queue.keeps_paths = true;
        return queue;
    }

private:
    std::mt19937 random_{5};
};

TEST_F(QueuePaths, CrossTheBoxesThatTheyCrossInDoublePrecision) {
    for (const double extent : {1e-12, 1.0, 1e12}) {
        for (const std::size_t count : {0u, 1u, 33u, 3'000u}) {
            SCOPED_TRACE(::testing::Message() << extent << ' ' << count);
            std::vector<Path> paths = random_paths(count, extent);
            if (count > 10) {
                paths[3].at[0] = paths[3].at[1] = paths[3].at[2]; // no length
                paths[4].at[1].x = paths[4].at[0].x;              // along a face
            }
            PhotonQueue queue = queue_of(1);
            replace(queue, 0, 1, paths);
            const auto e = static_cast<float>(extent);
            // A block, a plate without thickness, one box far away.
            MovedBoxes moved{{{-0.2f * e, 0, 0.1f * e, 0, 0.1f * e, 0.2f * e, 0.3f * e, 0},
                              {0.5f * e, -e, -0.3f * e, 0, 0.5f * e, 0.4f * e, 0.3f * e, 0},
                              {3 * e, 3 * e, 3 * e, 0, 4 * e, 4 * e, 4 * e, 0}},
                             {4, 7, 9}};
            mark_crossed(device(), queue, 0, moved);
            if (count == 0) {
                EXPECT_EQ(share_crossed(device(), queue, 0, moved), 0);
                continue;
            }
            const std::vector<std::uint32_t> found = crossed(queue);
            const std::vector<std::size_t> of = order(queue, paths);
            std::size_t blocks = 0, plates = 0;
            ASSERT_EQ(found.size(), count);
            for (std::size_t i = 0; i < count; ++i) {
                ASSERT_LT(of[i], count);
                for (const double by : {-1e-6 * extent, 1e-6 * extent}) {
                    const bool plate = is_crossed(moved.boxes[1], paths[of[i]], by);
                    const bool block = is_crossed(moved.boxes[0], paths[of[i]], by);
                    const std::uint32_t expected = plate ? 7 : block ? 4 : 0;
                    if (by < 0) {
                        ASSERT_GE(found[i], expected); // surely crossed
                    } else {
                        ASSERT_LE(found[i], expected);
                        blocks += block ? 1 : 0;
                        plates += plate ? 1 : 0;
                    }
                }
            }
            if (count > 100) {
                EXPECT_GT(blocks, count / 50);
                EXPECT_GT(plates, count / 50);
                EXPECT_NEAR(share_crossed(device(), queue, 0, moved) * double(count),
                            double(std::count_if(found.begin(), found.end(),
                                                 [](std::uint32_t at) { return at > 0; })),
                            0.5);
            }
        }
    }
}

TEST_F(QueuePaths, BlocksTracedSinceCountTheMoreOnTheseAlone) {
    PhotonQueue queue = queue_of(2);
    const std::vector<Path> first = random_paths(900), second = random_paths(900);
    replace(queue, 0, 1, first);
    MovedBoxes moved;
    const BoxRecord box{-0.3f, -0.3f, -0.3f, 0, 0.3f, 0.3f, 0.3f, 0};
    add_moved_boxes(moved, std::span(&box, 1), 1, 0);
    mark_crossed(device(), queue, every_block, moved);
    replace(queue, 1, 2, second);
    mark_crossed(device(), queue, 1, moved);
    queue.blocks[0].weight = 0.25f;
    queue.blocks[1].weight = 0.75f;
    std::vector<Path> all = first;
    all.insert(all.end(), second.begin(), second.end());
    const std::vector<PhotonRecord> found = map_of(queue);
    const std::vector<std::size_t> of = order(queue, all);
    std::size_t dropped = 0;
    for (const Path& path : first) {
        dropped += is_crossed(box, path, 0) ? 1 : 0;
    }
    EXPECT_GT(dropped, 50u);
    EXPECT_NEAR(double(found.size()), double(all.size() - dropped), 1);
    for (std::size_t i = 0; i < found.size(); ++i) {
        const bool lies_there = is_crossed(box, all[of[i]], 0);
        const float weight = of[i] < first.size() ? 0.25f : lies_there ? 1.0f : 0.75f;
        if (lies_there == is_crossed(box, all[of[i]], 1e-6)) {
            ASSERT_FLOAT_EQ(found[i].flux_r, weight) << i;
        }
    }
    // Once the box is older than every block, all count alike.
    forget_moved_boxes(moved, 1);
    EXPECT_TRUE(moved.boxes.empty());
    replace(queue, 0, 3, first);
    mark_crossed(device(), queue, 0, moved);
    EXPECT_EQ(queue.entries, all.size());
}

TEST_F(QueuePaths, ManyBoxesAreJoined) {
    std::vector<BoxRecord> boxes;
    for (int i = 0; i < 1'000; ++i) {
        const auto x = static_cast<float>(i);
        boxes.push_back({x, 0, 0, 0, x + 0.5f, 1, 1, 0});
    }
    MovedBoxes moved;
    add_moved_boxes(moved, boxes, 3, 0.25);
    ASSERT_LE(moved.boxes.size(), 16u);
    ASSERT_EQ(moved.boxes.size(), moved.moments.size());
    EXPECT_EQ(moved.boxes.front().low_x, -0.25f);
    EXPECT_EQ(moved.boxes.back().high_x, 999.75f);
    for (std::size_t i = 1; i < moved.boxes.size(); ++i) {
        EXPECT_LE(moved.boxes[i].low_x, moved.boxes[i - 1].high_x + 0.5f);
    }
    add_moved_boxes(moved, {}, 4, 0);
    EXPECT_EQ(moved.moments.back(), 3u);
}

} // namespace
} // namespace argand
