// The table from which area samples are taken, against sums in double precision.
#include "world/area_table.hpp"

#include "device_fixture.hpp"
#include "methods/scenes.hpp"
#include "shared/morton.h"
#include "shared/triangle_piece.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace argand::testing {
namespace {

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

/// What the device finds.
struct Table {
    std::vector<double> areas; ///< of each triangle on which photons may lie
    std::vector<AreaSumRecord> sums;
    double area = 0;
};

class AreaTable : public DeviceTest {
protected:
    Table table_of(const Scene& scene, const SampledPart& part = {}) {
        Device& device = open();
        std::vector<glm::vec4> positions;
        positions.reserve(scene.positions.size());
        for (const glm::vec3& position : scene.positions) {
            positions.emplace_back(position, 0);
        }
        std::vector<glm::uvec4> triangles;
        triangles.reserve(scene.triangles.size());
        for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
            triangles.emplace_back(scene.triangles[i], scene.triangle_material[i]);
        }
        const PhotonSurfaces surfaces = find_photon_surfaces(
            device, scene, argand::upload(device, "positions", positions),
            argand::upload(device, "triangles", triangles), bounds(scene), 0.25f);
        const SampledAreas sampled = sample_areas(device, surfaces, part);
        Table table{.sums = download<AreaSumRecord>(device, sampled.sums, sampled.pieces),
                    .area = sampled.area};
        for (const glm::vec2& area :
             download<glm::vec2>(device, surfaces.areas, scene.triangles.size())) {
            table.areas.push_back(double(area.x) + area.y);
        }
        return table;
    }
};

/// Each piece's first number is the share of the area before it, to a unit, and the table holds
/// every triangle that has an area once, in the order of the curve and then of the file.
void expect_right_sums(const Scene& scene, const Table& table) {
    long double area = 0;
    double largest = 0;
    std::uint32_t with_area = 0;
    for (const double of_triangle : table.areas) {
        area += of_triangle;
        largest = std::max(largest, of_triangle);
        with_area += of_triangle > 0 ? 1 : 0;
    }
    ASSERT_EQ(table.sums.size(), with_area);
    // Each area is rounded by up to two units, of which the largest has 2^62 / (2 count) or more.
    const double rounding = 4.0 * with_area * with_area * std::exp2(-62) * largest;
    EXPECT_NEAR(table.area, double(area), rounding + 1e-14 * double(area));
    const double tolerance = 1 + rounding / std::max(double(area), 1e-300) * 4294967296.0;
    const Bounds box = bounds(scene);
    long double before = 0;
    std::pair<std::uint32_t, std::uint32_t> last{};
    for (std::size_t k = 0; k < table.sums.size(); ++k) {
        const AreaSumRecord& record = table.sums[k];
        ASSERT_EQ(record.piece, whole_triangle);
        ASSERT_GT(table.areas[record.triangle], 0);
        const glm::uvec3& t = scene.triangles[record.triangle];
        const glm::vec3 middle =
            (scene.positions[t.x] + scene.positions[t.y] + scene.positions[t.z]) / 3.0f;
        const std::pair<std::uint32_t, std::uint32_t> place{morton30(middle, box.low, box.high),
                                                            record.triangle};
        ASSERT_TRUE(k == 0 || last < place) << k;
        last = place;
        ASSERT_NEAR(double(record.before), std::floor(double(before / area * 4294967296.0L)),
                    tolerance)
            << k;
        before += table.areas[record.triangle];
    }
}

/// Triangles of all shapes, about one in ten of them without area and one in ten a mirror.
Scene random_scene(std::uint32_t triangles, double scale, double offset, std::uint32_t seed = 1) {
    Scene scene;
    add_material(scene, lambertian(glm::vec3(0.5f)));
    add_material(scene, mirror());
    std::mt19937 random(seed);
    const auto uniform = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    const auto vector = [&](double size) {
        return size * glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    };
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const glm::dvec3 a = offset * glm::dvec3(1, 2, -1) + vector(scale);
        const glm::dvec3 across = vector(scale * std::exp2(uniform(-12, 0)));
        const bool is_needle = i % 4 == 0;
        const glm::dvec3 up = is_needle
                                  ? uniform(-1, 1) * across + 1e-5 * vector(glm::length(across))
                                  : vector(scale * std::exp2(uniform(-12, 0)));
        const double size = i % 10 == 3 ? 0 : 1;
        add_triangle(scene, a, a + size * across, a + up, i % 10 == 7 ? 1 : 0);
    }
    return scene;
}

glm::dvec3 edge(const Scene& scene, std::size_t triangle, int to) {
    const glm::uvec3& t = scene.triangles[triangle];
    return glm::dvec3(scene.positions[t[to]]) - glm::dvec3(scene.positions[t[0]]);
}

TEST(AreaPieces, PiecesOfAPieceMakeItUp) {
    const TrianglePiece whole = triangle_piece(whole_triangle);
    EXPECT_EQ(share_of(whole), 1);
    for (const uint number : {1u, 5u, 22u, 91u}) {
        for (uint k = 0; k < 4; ++k) {
            const TrianglePiece part = triangle_piece(4 * number + k);
            EXPECT_EQ(share_of(part), share_of(triangle_piece(number)) / 4);
            EXPECT_EQ(share_of(part), std::exp2(-2.0 * divisions_of(4 * number + k)));
            EXPECT_EQ(part.a, part_of_piece(triangle_piece(number), k).a);
        }
    }
}

// Of needles the cross product loses digits of the edges, of which twice single precision has 48.
TEST_F(AreaTable, AreasAreThoseOfDoublePrecision) {
    for (const double scale : {1e-6, 1.0, 1e6, 1e15}) {
        for (const double offset : {0.0, 1000 * scale}) {
            SCOPED_TRACE(scale);
            SCOPED_TRACE(offset);
            const Scene scene = random_scene(2'001, scale, offset);
            const Table table = table_of(scene);
            for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
                const double expected = scene.triangle_material[i] == 0 ? area(scene, i) : 0;
                const double rounding = std::exp2(-44) * glm::length(edge(scene, i, 1)) *
                                        glm::length(edge(scene, i, 2));
                ASSERT_NEAR(table.areas[i], expected, rounding) << i;
            }
            expect_right_sums(scene, table);
        }
    }
}

TEST_F(AreaTable, MayHaveAnySize) {
    for (const std::uint32_t triangles : {0u, 1u, 2u, 3u, 63u, 64u, 65u, 257u, 4097u, 100'003u}) {
        SCOPED_TRACE(triangles);
        const Scene scene = random_scene(triangles, 1, 0, triangles);
        expect_right_sums(scene, table_of(scene));
    }
}

// In single precision the small ones would vanish beside the sum of those before them.
TEST_F(AreaTable, SmallTrianglesCountBesideALargeOne) {
    Scene scene = ground();
    constexpr std::uint32_t small = 50'000;
    constexpr float size = 1e-4f; // a 10^13th of the ground
    for (std::uint32_t i = 0; i < small; ++i) {
        const glm::vec3 a(50.0f + size * static_cast<float>(i % 200), 1,
                          50.0f + size * static_cast<float>(i / 200));
        add_triangle(scene, a, a + glm::vec3(size, 0, 0), a + glm::vec3(0, size, 0), 0);
    }
    const Table table = table_of(scene);
    EXPECT_EQ(table.sums.size(), small + 2);
    expect_right_sums(scene, table);
    EXPECT_NEAR((table.area - 4.0 * half * half) / (small * 0.5 * size * size), 1, 0.05);
}

TEST_F(AreaTable, OfDuplicatesOnlyTheFirstHasAnArea) {
    Scene scene;
    const std::uint32_t wall = add_material(scene, lambertian(glm::vec3(0.5f)));
    const std::uint32_t metal = add_material(scene, mirror());
    const glm::vec3 a(0, 1, 0);
    const glm::vec3 b(1, -0.0f, 0);
    const glm::vec3 c(1, 1, 2);
    const glm::vec3 zero_b(1, 0, 0);
    add_triangle(scene, a, b, c, wall);
    add_triangle(scene, zero_b, c, a, wall); // turned, and 0 instead of -0
    add_triangle(scene, c, a, b, metal);
    add_triangle(scene, a, c, b, metal); // the other front
    add_triangle(scene, b, a, c, wall);
    add_triangle(scene, a, b, c + glm::vec3(0, 1, 0), wall);
    const Table table = table_of(scene);
    for (const std::size_t i : {1u, 2u, 3u, 4u}) {
        EXPECT_EQ(table.areas[i], 0) << i;
    }
    EXPECT_GT(table.areas[0], 0);
    EXPECT_GT(table.areas[5], 0);
    expect_right_sums(scene, table);
}

// Lavapipe ends loops after 65,535 iterations.
TEST_F(AreaTable, OfManyCopiesOneHasAnArea) {
    Scene scene;
    const std::uint32_t wall = add_material(scene, lambertian(glm::vec3(0.5f)));
    for (int i = 0; i < 70'000; ++i) {
        add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, wall);
        add_triangle(scene, {2, 2, 2}, {2, 2, 2}, {2, 2, 2}, wall);
    }
    const Table table = table_of(scene);
    ASSERT_EQ(table.sums.size(), 1u);
    EXPECT_EQ(table.sums[0].triangle, 0u);
    EXPECT_EQ(table.area, 0.5);
}

TEST_F(AreaTable, WithoutALimitTrianglesAreWhole) {
    const Table table = table_of(ground());
    ASSERT_EQ(table.sums.size(), 2u);
    EXPECT_EQ(table.area, 4.0 * half * half);
    EXPECT_EQ(table.sums[0].before, 0u);
    EXPECT_EQ(table.sums[1].before, 1u << 31u);
}

// Every point within reach lies in exactly one piece, and the pieces lie hardly beyond.
TEST_F(AreaTable, CoversThePartWithinReach) {
    const Scene scene = ground();
    const glm::vec3 center(30, 1, -20);
    const double reach = 5;
    const Table table = table_of(scene, {center, reach});
    EXPECT_LT(table.area, 4 * std::numbers::pi * reach * reach);
    double area = 0;
    for (const AreaSumRecord& record : table.sums) {
        EXPECT_NEAR(double(record.before), area / table.area * 4294967296.0, 1);
        area += share_of(triangle_piece(record.piece)) * 2.0 * half * half;
    }
    EXPECT_NEAR(area, table.area, 1e-12 * table.area);
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

// Needles are divided across, too: more pieces than lavapipe has iterations.
TEST_F(AreaTable, NeedlesMayHaveManyPieces) {
    Scene scene;
    const std::uint32_t wall = add_material(scene, lambertian(glm::vec3(0.5f)));
    add_quad(scene, {-500, 0, -0.005f}, {1000, 0, 0}, {0, 0, 0.01f}, wall);
    const Table table = table_of(scene, {{0.3f, 0, 0}, 1});
    EXPECT_GT(table.sums.size(), 65'536u);
    EXPECT_GE(table.area, 0.02 * (1 - 1e-5));
    EXPECT_LE(table.area, 0.025);
}

TEST_F(AreaTable, NeedlesAreNotDividedIntoMillions) {
    Scene scene;
    const std::uint32_t wall = add_material(scene, lambertian(glm::vec3(0.5f)));
    constexpr int needles = 24;
    for (int i = 0; i < needles; ++i) {
        add_quad(scene, {-500, 0, 0.01f * static_cast<float>(i)}, {1000, 0, 0}, {0, 0, 0.01f},
                 wall);
    }
    const Table table = table_of(scene, {{0.3f, 0, 0}, 1});
    EXPECT_GT(table.sums.size(), 1u << 18u);
    EXPECT_LE(table.sums.size(), 1u << 20u);
    EXPECT_GE(table.area, needles * 0.019);
    EXPECT_LE(table.area, needles * 0.03);
}

TEST_F(AreaTable, NothingWithinReach) {
    const Table table = table_of(ground(), {{0, 50, 0}, 5});
    EXPECT_TRUE(table.sums.empty());
    EXPECT_EQ(table.area, 0);
}

TEST_F(AreaTable, SceneWithoutTriangles) {
    Scene scene;
    add_material(scene, lambertian(glm::vec3(0.5f)));
    EXPECT_TRUE(table_of(scene).sums.empty());
}

} // namespace
} // namespace argand::testing
