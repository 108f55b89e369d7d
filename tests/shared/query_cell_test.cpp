// Tests the cells within which queries share an answer.
#include "shared/query_cell.h"

#include <gtest/gtest.h>
#include <map>
#include <random>
#include <tuple>

namespace argand {
namespace {

using Key = std::tuple<uint, uint, uint, uint>;

Key cell(vec3 p, vec3 normal, float largest, float size) {
    const uvec4 c = query_cell(p, normal, largest, size);
    return {c.x, c.y, c.z, c.w};
}

struct Extent {
    vec3 low{1e30f}, high{-1e30f};
    int count = 0;
};

/// Random points of a plane through `center`, by cell.
std::map<Key, Extent> cells_of_plane(vec3 center, vec3 normal, float half, float largest,
                                     float size) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> u(-half, half);
    const Frame frame = make_frame(normal);
    std::map<Key, Extent> cells;
    for (int i = 0; i < 40'000; ++i) {
        const vec3 p = center + frame.x * u(random) + frame.y * u(random);
        Extent& e = cells[cell(p, normal, largest, size)];
        e.low = min(e.low, p);
        e.high = max(e.high, p);
        ++e.count;
    }
    return cells;
}

TEST(QueryCell, HoldsPointsWithinTwiceItsEdge) {
    const vec3 normals[] = {
        {0, 1, 0}, {0, 0, -1}, normalize(vec3(1, 2, -3)), normalize(vec3(-0.1f, 0.05f, 1))};
    for (const vec3 normal : normals) {
        for (const float wanted : {1.0f, 0.1f, 0.06f, 0.01f}) {
            const float edge =
                0.1f * std::exp2(std::floor(std::log2(std::min(wanted / 0.1f, 1.0f))));
            const auto cells = cells_of_plane({0.3f, -2, 5}, normal, 0.5f, 0.1f, wanted);
            for (const auto& [key, extent] : cells) {
                // A point is jittered by up to half an edge along each axis.
                ASSERT_LE(glm::length(extent.high - extent.low), 2 * 1.7321f * edge)
                    << "size " << wanted;
            }
            // About the plane's area in edges squared, and a row more on each side; slanted planes
            // also cross the cells' heights.
            const double squares = 1 / (double(edge) * edge);
            EXPECT_GT(static_cast<double>(cells.size()), 0.9 * squares * (squares < 2000 ? 1 : 0.5))
                << "size " << wanted;
            EXPECT_LT(static_cast<double>(cells.size()), 2.5 * (1 / edge + 2) * (1 / edge + 2))
                << "size " << wanted;
        }
    }
}

TEST(QueryCell, CellsAreNotSharedAcrossSurfaces) {
    const vec3 p(0.5f, 0.25f, -1.2f);
    const vec3 up(0, 1, 0);
    const float edge = 0.1f;
    EXPECT_EQ(cell(p, up, edge, 1), cell(p, up, edge, 1));
    EXPECT_NE(cell(p, up, edge, 1), cell(p, -up, edge, 1));
    EXPECT_NE(cell(p, up, edge, 1), cell(p, normalize(vec3(1, 3, 0)), edge, 1));
    // A different size gives a different cell.
    EXPECT_NE(cell(p, up, edge, 1), cell(p, up, edge, 0.05f));
    // A board half an edge above the floor.
    std::mt19937 random(1);
    std::uniform_real_distribution<float> u(0, 1);
    for (int i = 0; i < 1000; ++i) {
        const vec3 q(u(random), u(random), u(random));
        ASSERT_NE(cell(q, up, edge, 1), cell(q + up * (0.5f * edge), up, edge, 1));
    }
}

TEST(QueryCell, ScalesWithTheScene) {
    for (const float scale : {1e-20f, 1e-6f, 1.0f, 1e6f, 1e20f}) {
        const auto cells =
            cells_of_plane(vec3(1, 2, 3) * scale, {0, 1, 0}, 0.5f * scale, 0.1f * scale, 1e30f);
        EXPECT_GE(cells.size(), 100u) << "scale " << scale;
        EXPECT_LE(cells.size(), 144u) << "scale " << scale;
    }
    // Far away, where coordinates have no digits left for cells, the result is still valid.
    cell(vec3(3e38f), {1, 0, 0}, 1e-30f, 1e-30f);
}

TEST(QueryCell, DirectionsInACellAreClose) {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    for (const float alpha : {1e-3f, 0.0625f, 0.25f, 1.0f}) {
        const uint steps = direction_steps(alpha, 1);
        EXPECT_GE(steps, 4u);
        EXPECT_EQ(direction_steps(alpha, 0), 1u);
        EXPECT_LE(steps, 60u); // they fit into a byte on either side of 0
        std::map<uint, vec3> first;
        for (int i = 0; i < 50'000; ++i) {
            const vec3 v = normalize(vec3(normal(random), normal(random), normal(random)));
            const auto [found, is_new] = first.emplace(direction_cell(v, steps, uint(random())), v);
            // A cell is at most two steps wide; a step is at most half a turn over twice the steps,
            // and half as much again in corners.
            ASSERT_LT(std::acos(glm::dot(found->second, v) * 0.999999f),
                      1.5 * std::sqrt(2.0) * 3.1416 / steps)
                << "alpha " << alpha;
        }
        EXPECT_GT(first.size(), 2 * steps * steps);
    }
}

TEST(QueryCell, ShuffledSlotsCanBeInverted) {
    int above = 0;
    for (uint slot = 0; slot < 1u << 20; ++slot) {
        ASSERT_EQ(slot_of_shuffled(shuffled_slot(slot)), slot);
        above += shuffled_slot(slot) > shuffled_slot(slot + 1) ? 1 : 0;
    }
    EXPECT_NEAR(above, 1 << 19, 1 << 18);
    EXPECT_EQ(slot_of_shuffled(shuffled_slot(0xffffffffu)), 0xffffffffu);
}

} // namespace
} // namespace argand
