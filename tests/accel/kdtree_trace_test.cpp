// Rays through a kd-tree hit what they hit through the four-wide tree, to the bit.
#include "device_fixture.hpp"
#include "tracing.hpp"

#include <cstring>

namespace argand {
namespace {

Tracer through_kdtree(Device& device, const Mesh& mesh, const KdTreeSettings& settings = {}) {
    return {device,
            build_triangle_kdtree(device, upload(device, "positions", mesh.positions),
                                  upload(device, "triangles", mesh.triangles),
                                  static_cast<std::uint32_t>(mesh.triangles.size()), settings)};
}

void expect_same_bits(const std::vector<HitRecord>& hits, const std::vector<HitRecord>& expected) {
    ASSERT_EQ(hits.size(), expected.size());
    std::size_t differing = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        differing += std::memcmp(&hits[i], &expected[i], sizeof(HitRecord)) == 0 ? 0 : 1;
    }
    EXPECT_EQ(differing, 0u) << "of " << hits.size();
}

/// Tests rays through both trees against one another. Returns how many hit.
std::size_t expect_same_hits(Device& device, const Mesh& mesh, const std::vector<RayRecord>& rays,
                             const KdTreeSettings& settings = {}) {
    const Tracer wide(device, mesh);
    const Tracer tracer = through_kdtree(device, mesh, settings);
    const std::vector<HitRecord> expected = wide.closest(rays);
    expect_same_bits(tracer.closest(rays), expected);
    EXPECT_EQ(tracer.any(rays), wide.any(rays));
    std::size_t hits = 0;
    for (const HitRecord& hit : expected) {
        hits += hit.triangle != no_triangle ? 1 : 0;
    }
    return hits;
}

using KdTreeTrace = VariantTest;

TEST_P(KdTreeTrace, HitsTheSame) {
    Device& device = open_variant();
    for (const std::size_t count : {1, 2, 33, 1000}) {
        for (const float size : {0.05f, 0.5f}) {
            SCOPED_TRACE(count);
            const Mesh mesh = random_triangles(count, size, 1);
            const auto rays = random_rays(1000, 1.5f, 2);
            const std::size_t hits = expect_same_hits(device, mesh, rays);
            EXPECT_TRUE(hits > 100 || count < 1000 || size < 0.1f);
        }
    }
}

TEST_P(KdTreeTrace, HitsTheSameAtAnyScale) {
    Device& device = open_variant();
    for (const float scale : {0x1p30f, 0x1p-30f}) {
        SCOPED_TRACE(scale);
        Mesh mesh = random_triangles(500, 0.3f, 1);
        for (glm::vec4& position : mesh.positions) {
            position = glm::vec4(glm::vec3(position) * scale, 1);
        }
        std::vector<RayRecord> rays = random_rays(1000, 1.5f, 2);
        for (RayRecord& ray : rays) {
            ray.origin_x *= scale;
            ray.origin_y *= scale;
            ray.origin_z *= scale;
        }
        EXPECT_GT(expect_same_hits(device, mesh, rays), 100u);
    }
}

// Triangles and rays lie in planes of cells, and several triangles are hit at one distance.
TEST_P(KdTreeTrace, HitsTheSameInPlanesOfCells) {
    Device& device = open_variant();
    Mesh mesh;
    for (int x = 0; x < 8; ++x) {
        for (int y = 0; y < 8; ++y) {
            for (const int z : {0, 0, 3}) {
                mesh.add(glm::vec3(x, y, z), glm::vec3(x + 1, y, z), glm::vec3(x, y + 1, z));
                mesh.add(glm::vec3(x + 1, y, z), glm::vec3(x + 1, y + 1, z),
                         glm::vec3(x, y + 1, z));
                mesh.add(glm::vec3(x, y, z), glm::vec3(x, y + 1, z), glm::vec3(x, y, z + 1));
            }
        }
    }
    std::vector<RayRecord> rays;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = -4; i <= 36; ++i) {
            for (int j = -4; j <= 36; ++j) {
                glm::vec3 origin;
                origin[axis] = -5;
                origin[(axis + 1) % 3] = float(i) / 4;
                origin[(axis + 2) % 3] = float(j) / 4;
                glm::vec3 along(0);
                along[axis] = 1;
                rays.push_back(make_ray(origin, along));
                rays.push_back(make_ray(-origin + glm::vec3(8), -along));
                along[(axis + 1) % 3] = 1;
                rays.push_back(make_ray(origin, along));
            }
        }
    }
    EXPECT_GT(expect_same_hits(device, mesh, rays), rays.size() / 5);
}

TEST_P(KdTreeTrace, HitsTheSameSliversAndDegenerateTriangles) {
    Device& device = open_variant();
    Mesh mesh;
    constexpr int count = 300;
    for (int i = 0; i < count; ++i) {
        const float from = float(i) / count;
        const float to = float(i + 1) / count;
        mesh.add({-1, -1, 0}, {1, 2 * from - 1, 0}, {1, 2 * to - 1, 0});
        mesh.add({-1, -1, 0}, {2 * from - 1, 1, 0}, {2 * to - 1, 1, 0});
        mesh.add({from, from, 0.5f}, {from, from, 0.5f}, {to, from, 0.5f});
        mesh.add({std::nanf(""), from, 0}, {0, INFINITY, 0}, {to, 1, 0});
    }
    std::mt19937 random(3);
    std::vector<RayRecord> rays;
    for (int i = 0; i < 1000; ++i) {
        glm::vec3 target = random_point(random, 0.999f);
        target.z = 0;
        const glm::vec3 origin = random_point(random) + glm::vec3(0, 0, 3);
        rays.push_back(make_ray(origin, target - origin));
    }
    EXPECT_EQ(expect_same_hits(device, mesh, rays), rays.size());
}

TEST_P(KdTreeTrace, HitsTheSameFromInsideASphere) {
    Device& device = open_variant();
    const Mesh mesh = bumpy_sphere(16, 0.2f);
    std::mt19937 random(9);
    std::vector<RayRecord> rays;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::vec3 origin = 0.3f * random_point(random);
        const glm::vec3 a = mesh.corner(i, 0);
        const glm::vec3 b = mesh.corner(i, 1);
        for (const glm::vec3 target : {a, (a + b) / 2.0f, mesh.corner(i, 2)}) {
            rays.push_back(make_ray(origin, target - origin));
            rays.push_back(make_ray(origin, target - origin, i % 2 == 0 ? 1.0f : 0.5f));
        }
    }
    EXPECT_GT(expect_same_hits(device, mesh, rays), rays.size() / 2);
}

TEST_P(KdTreeTrace, HitsTheSameInATreeThatStoppedEarly) {
    Device& device = open_variant();
    const Mesh mesh = random_triangles(2000, 0.3f, 1);
    const auto rays = random_rays(1000, 1.5f, 2);
    EXPECT_TRUE(through_kdtree(device, mesh, {.memory = 100'000}).bvh.kdtree.stopped);
    EXPECT_GT(expect_same_hits(device, mesh, rays, {.memory = 100'000}), 100u);
}

TEST_P(KdTreeTrace, OfNoTriangleHitsNothing) {
    Device& device = open_variant();
    const auto rays = random_rays(100, 1, 2);
    EXPECT_EQ(expect_same_hits(device, Mesh{}, rays), 0u);
}

TEST_P(KdTreeTrace, DoesNotDependOnTheStepLimit) {
    Device& device = open_variant();
    const Tracer tracer = through_kdtree(device, random_triangles(1000, 0.3f, 1));
    const auto rays = random_rays(500, 1, 2);
    const auto hits = tracer.closest(rays);
    const auto occluded = tracer.any(rays);
    for (const std::uint32_t limit : {3u, 50u}) {
        SCOPED_TRACE(limit);
        expect_same_bits(tracer.closest(rays, {.step_limit = limit, .careful = true}), hits);
        EXPECT_EQ(tracer.any(rays, {.step_limit = limit, .careful = true}), occluded);
        expect_same_bits(tracer.closest(rays, {.step_limit = limit, .slots = 100, .careful = true}),
                         hits);
    }
    std::uint32_t unfinished = 0;
    tracer.closest(rays, {.step_limit = 20}, unfinished);
    EXPECT_GT(unfinished, 0u);
    EXPECT_LT(unfinished, rays.size());
}

INSTANTIATE_VARIANTS(KdTreeTrace);

} // namespace
} // namespace argand
