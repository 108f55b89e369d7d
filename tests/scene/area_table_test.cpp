#include "world/area_table.hpp"

#include "methods/scenes.hpp"
#include "shared/triangle_piece.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace argand::testing {
namespace {

constexpr float follow_roughness = 0.25f;
constexpr float half = 100; // of the ground

Scene ground() {
    Scene scene;
    add_floor(scene, half, 0, add_material(scene, lambertian(glm::vec3(0.5f))));
    return scene;
}

/// Area of a piece over that of its triangle: that of a triangle of barycentric coordinates.
double share_of(const TrianglePiece& p) {
    const vec2 ab = p.b - p.a;
    const vec2 ac = p.c - p.a;
    return std::abs(double(ab.x) * ac.y - double(ab.y) * ac.x);
}

AreaTable table_of(const Scene& scene, const SampledPart& part) {
    return make_area_table(scene, areas_for_photons(scene, follow_roughness), part);
}

TEST(AreaTable, PiecesOfAPieceMakeItUp) {
    const TrianglePiece whole = triangle_piece(whole_triangle);
    EXPECT_EQ(share_of(whole), 1);
    for (const uint number : {1u, 5u, 22u, 91u}) {
        for (uint k = 0; k < 4; ++k) {
            const TrianglePiece part = triangle_piece(4 * number + k);
            EXPECT_EQ(share_of(part), share_of(triangle_piece(number)) / 4);
            EXPECT_EQ(part.a, part_of_piece(triangle_piece(number), k).a);
        }
    }
}

TEST(AreaTable, WithoutALimitTrianglesAreWhole) {
    const AreaTable table = table_of(ground(), {});
    ASSERT_EQ(table.sums.size(), 2u);
    EXPECT_EQ(table.sums[0].piece, whole_triangle);
    EXPECT_EQ(table.sums[1].piece, whole_triangle);
    EXPECT_NEAR(table.area, 4.0 * half * half, 1e-3);
}

// Every point within reach lies in exactly one piece, and the pieces lie hardly beyond.
TEST(AreaTable, CoversThePartWithinReach) {
    const Scene scene = ground();
    const glm::vec3 center(30, 1, -20);
    const double reach = 5;
    const AreaTable table = table_of(scene, {center, reach});
    EXPECT_LT(table.area, 4 * std::numbers::pi * reach * reach);
    double area = 0;
    for (const AreaSumRecord& record : table.sums) {
        area += share_of(triangle_piece(record.piece)) * 2.0 * half * half;
    }
    EXPECT_NEAR(area, table.area, 1e-6 * table.area);
    for (int i = 0; i < 1000; ++i) {
        const double angle = 2.4 * i;
        const double distance = 0.97 * reach * std::sqrt((i + 0.5) / 1000);
        const double x = center.x + distance * std::cos(angle);
        const double z = center.z + distance * std::sin(angle);
        int containing = 0;
        for (const AreaSumRecord& record : table.sums) {
            const glm::uvec3& t = scene.triangles[record.triangle];
            const TrianglePiece p = triangle_piece(record.piece);
            const auto place_of = [&](const vec2& b) {
                const glm::vec3 at = scene.positions[t.x] +
                                     (scene.positions[t.y] - scene.positions[t.x]) * b.x +
                                     (scene.positions[t.z] - scene.positions[t.x]) * b.y;
                return glm::dvec2(at.x, at.z);
            };
            const std::array<glm::dvec2, 3> corners = {place_of(p.a), place_of(p.b), place_of(p.c)};
            const auto side = [&](std::size_t k) {
                const glm::dvec2 e = corners[(k + 1) % 3] - corners[k];
                const glm::dvec2 d = glm::dvec2(x, z) - corners[k];
                return e.x * d.y - e.y * d.x > 0;
            };
            containing += side(0) == side(1) && side(1) == side(2) ? 1 : 0;
        }
        EXPECT_EQ(containing, 1) << x << ", " << z;
    }
}

TEST(AreaTable, NothingWithinReach) {
    const AreaTable table = table_of(ground(), {{0, 50, 0}, 5});
    EXPECT_TRUE(table.sums.empty());
    EXPECT_EQ(table.area, 0);
}

TEST(AreaTable, SceneWithoutTriangles) {
    Scene scene;
    add_material(scene, lambertian(glm::vec3(0.5f)));
    EXPECT_TRUE(table_of(scene, {}).sums.empty());
}

} // namespace
} // namespace argand::testing
