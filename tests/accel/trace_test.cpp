#include "device_fixture.hpp"
#include "one_thread.hpp"
#include "shared/intersect.h"
#include "tracing.hpp"

namespace argand {
namespace {

using Trace = VariantTest;

void expect_same(const std::vector<HitRecord>& a, const std::vector<HitRecord>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_TRUE(a[i].triangle == b[i].triangle && a[i].t == b[i].t && a[i].u == b[i].u &&
                    a[i].v == b[i].v)
            << i;
    }
}

/// Rays that pass within rounding of an edge may go either way; all others must agree.
void expect_exact(const Mesh& mesh, const std::vector<RayRecord>& rays,
                  const std::vector<HitRecord>& hits) {
    std::size_t differing = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const ExactHit exact = exact_closest(mesh, rays[i]);
        if (exact.triangle != hits[i].triangle) {
            ++differing;
        } else if (exact.triangle != no_triangle) {
            const double grazing = exact_grazing(mesh, exact.triangle, rays[i]);
            EXPECT_NEAR(hits[i].t, exact.t, 4e-6 / grazing) << i;
            EXPECT_NEAR(hits[i].u, exact.u, 1e-4 / grazing) << i;
            EXPECT_NEAR(hits[i].v, exact.v, 1e-4 / grazing) << i;
        } else {
            EXPECT_EQ(hits[i].t, rays[i].t_max) << i;
        }
    }
    EXPECT_LE(differing, rays.size() / 1000);
}

TEST_P(Trace, FindsWhatDoublePrecisionFinds) {
    Device& device = open_variant();
    for (const std::size_t count : {1, 2, 3, 7, 100, 1000}) {
        SCOPED_TRACE(count);
        const Mesh mesh = random_triangles(count, 0.3f, 1);
        const std::vector<RayRecord> rays = random_rays(2000, 1.5f, 2);
        const Tracer tracer(device, mesh);
        const std::vector<HitRecord> hits = tracer.closest(rays);
        expect_exact(mesh, rays, hits);
        const std::vector<std::uint32_t> occluded = tracer.any(rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(occluded[i], hits[i].triangle != no_triangle ? 1u : 0u) << i;
        }
    }
}

TEST_P(Trace, FindsTheSameAtAnyScale) {
    Device& device = open_variant();
    const Mesh mesh = random_triangles(300, 0.3f, 1);
    const std::vector<RayRecord> rays = random_rays(1000, 1.5f, 2);
    const std::vector<HitRecord> hits = Tracer(device, mesh).closest(rays);
    for (const float scale : {0x1p20f, 0x1p-20f}) {
        SCOPED_TRACE(scale);
        Mesh scaled = mesh;
        for (glm::vec4& position : scaled.positions) {
            position = glm::vec4(glm::vec3(position) * scale, 1);
        }
        std::vector<RayRecord> from = rays;
        for (RayRecord& ray : from) {
            ray.origin_x *= scale;
            ray.origin_y *= scale;
            ray.origin_z *= scale;
        }
        std::vector<HitRecord> found = Tracer(device, scaled).closest(from);
        for (HitRecord& hit : found) {
            hit.t /= scale;
        }
        expect_same(found, hits);
    }
}

TEST_P(Trace, OfNoTriangleHitsNothing) {
    Device& device = open_variant();
    const Tracer tracer(device, Mesh{});
    const std::vector<RayRecord> rays = random_rays(100, 1, 2);
    for (const HitRecord& hit : tracer.closest(rays)) {
        EXPECT_EQ(hit.triangle, no_triangle);
    }
    EXPECT_THAT(tracer.any(rays), testing::Each(0u));
    EXPECT_TRUE(Tracer(device, random_triangles(10, 1, 1)).closest({}).empty());
}

TEST_P(Trace, EndsAtTMax) {
    Device& device = open_variant();
    Mesh mesh;
    mesh.add({-1, -1, 2}, {1, -1, 2}, {0, 1, 2});
    mesh.add({-1, -1, 4}, {1, -1, 4}, {0, 1, 4});
    mesh.add({-1, -1, -1}, {1, -1, -1}, {0, 1, -1}); // behind
    const std::vector<RayRecord> rays{
        make_ray({0, 0, 0}, {0, 0, 1}, 1.9f),     make_ray({0, 0, 0}, {0, 0, 1}, 2),
        make_ray({0, 0, 0}, {0, 0, 1}, INFINITY), make_ray({0, 0, 0}, {0, 0, 1}, 0),
        make_ray({0, 0, 0}, {0, 0, 1}, -1),       make_ray({0, 0, 3}, {0, 0, 2}, 0.5f),
        make_ray({0, 0, 2}, {0, 0, 1}, 0)};
    const Tracer tracer(device, mesh);
    std::vector<std::uint32_t> triangles;
    for (const HitRecord& hit : tracer.closest(rays)) {
        triangles.push_back(hit.triangle);
    }
    EXPECT_THAT(triangles, testing::ElementsAre(no_triangle, 0, 0, no_triangle, no_triangle, 1, 0));
    EXPECT_THAT(tracer.any(rays), testing::ElementsAre(0, 1, 1, 0, 1, 1, 1));
}

TEST_P(Trace, LeavesOtherRaysAlone) {
    Device& device = open_variant();
    const Tracer tracer(device, random_triangles(500, 0.5f, 1));
    const std::vector<RayRecord> rays = random_rays(1000, 1, 2);
    const std::vector<HitRecord> all = tracer.closest(rays);
    const std::vector<std::uint32_t> active{7, 999, 0, 500, 3};
    const Buffer hits = device.allocate("hits", rays.size() * sizeof(HitRecord));
    for (const bool careful : {false, true}) {
        device.fill(hits, 0xabcdef01u);
        Traversal working = tracer.traversal(rays.size(), {.careful = careful});
        // Four of the five, and the device alone knows that.
        trace_closest(device, tracer.bvh, working,
                      {upload(device, "rays", rays), upload(device, "active", active), hits,
                       Count(upload(device, "counts", std::vector<std::uint32_t>{1, 2, 4}), 2,
                             active.size())});
        const std::vector<HitRecord> found = download<HitRecord>(device, hits, rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const bool chosen = i == 7 || i == 999 || i == 0 || i == 500;
            EXPECT_EQ(found[i].triangle, chosen ? all[i].triangle : 0xabcdef01u) << i;
        }
    }
}

TEST_P(Trace, MeetsRaysAlongTheAxes) {
    Device& device = open_variant();
    // A plane of squares; the rays go through their corners, edges and insides, and in its own
    // plane.
    Mesh mesh;
    for (int x = 0; x < 8; ++x) {
        for (int y = 0; y < 8; ++y) {
            mesh.add(glm::vec3(x, y, 0), glm::vec3(x + 1, y, 0), glm::vec3(x, y + 1, 0));
            mesh.add(glm::vec3(x + 1, y, 0), glm::vec3(x + 1, y + 1, 0), glm::vec3(x, y + 1, 0));
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        Mesh turned = mesh;
        for (glm::vec4& p : turned.positions) {
            p = axis == 0   ? glm::vec4(p.z, p.x, p.y, 1)
                : axis == 1 ? glm::vec4(p.y, p.z, p.x, 1)
                            : p;
        }
        glm::vec3 along(0);
        along[axis] = 1;
        std::vector<RayRecord> rays;
        for (int i = 0; i <= 32; ++i) {
            for (int j = 0; j <= 32; ++j) {
                glm::vec3 origin;
                origin[axis] = -5;
                origin[(axis + 1) % 3] = float(i) / 4;
                origin[(axis + 2) % 3] = float(j) / 4;
                rays.push_back(make_ray(origin, along));
                rays.push_back(make_ray(-origin, along)); // away from it
            }
        }
        const std::vector<HitRecord> hits = Tracer(device, turned).closest(rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(hits[i].triangle != no_triangle, i % 2 == 0) << axis << " " << i;
            EXPECT_EQ(hits[i].t, i % 2 == 0 ? 5 : INFINITY) << axis << " " << i;
        }
    }
}

TEST_P(Trace, IgnoresDegenerateTriangles) {
    Device& device = open_variant();
    const std::vector<RayRecord> rays = random_rays(2000, 1.5f, 2);
    const Mesh good = random_triangles(200, 0.4f, 1);
    const std::vector<HitRecord> expected = Tracer(device, good).closest(rays);
    // Beside each triangle a point, a line, and one that is not a number.
    Mesh mesh;
    const float nan = std::nanf("");
    for (std::size_t i = 0; i < good.triangles.size(); ++i) {
        const glm::vec3 a = good.corner(i, 0);
        const glm::vec3 b = good.corner(i, 1);
        mesh.add(a, a, a);
        mesh.add(a, b, a);
        mesh.add(i % 2 == 0 ? glm::vec3(nan) : a, b,
                 i % 3 == 0 ? glm::vec3(INFINITY, 0, 0) : glm::vec3(0, nan, 0));
        mesh.add(a, b, good.corner(i, 2));
    }
    std::vector<HitRecord> hits = Tracer(device, mesh).closest(rays);
    for (HitRecord& hit : hits) {
        hit.triangle = hit.triangle == no_triangle ? no_triangle
                       : hit.triangle % 4 == 3     ? hit.triangle / 4
                                                   : hit.triangle + 1000;
    }
    expect_same(hits, expected);
}

TEST_P(Trace, MeetsSlivers) {
    Device& device = open_variant();
    // A fan of needles that together are a square; no ray may slip through.
    Mesh mesh;
    constexpr int count = 2000;
    for (int i = 0; i < count; ++i) {
        const float from = float(i) / count;
        const float to = float(i + 1) / count;
        mesh.add({-1, -1, 0}, {1, 2 * from - 1, 0}, {1, 2 * to - 1, 0});
        mesh.add({-1, -1, 0}, {2 * from - 1, 1, 0}, {2 * to - 1, 1, 0});
    }
    std::mt19937 random(3);
    std::vector<RayRecord> rays;
    for (int i = 0; i < 4000; ++i) {
        glm::vec3 target = random_point(random, 0.999f);
        target.z = 0;
        const glm::vec3 origin = random_point(random) + glm::vec3(0, 0, 3);
        rays.push_back(make_ray(origin, target - origin));
    }
    for (const HitRecord& hit : Tracer(device, mesh).closest(rays)) {
        ASSERT_NE(hit.triangle, no_triangle);
        EXPECT_NEAR(hit.t, 1, 1e-5);
    }
}

/// How far the point with these weights is from the ray's exact one, in its triangle's plane.
double distance_from(const Mesh& mesh, const HitRecord& hit, const glm::dvec3& point) {
    const glm::dvec3 a(mesh.corner(hit.triangle, 0));
    const glm::dvec3 b(mesh.corner(hit.triangle, 1));
    const glm::dvec3 c(mesh.corner(hit.triangle, 2));
    const auto u = static_cast<double>(hit.u);
    const auto v = static_cast<double>(hit.v);
    return glm::length(a * (1 - u - v) + b * u + c * v - point);
}

// Strips of two slivers each, 2 long and 2·10^-6 wide, side by side in a slanting plane: no ray may
// slip through. Seen from the ray's origin vertices are rounded by a few percent of a sliver's
// width: near edges the next strip may be met, and the point lies elsewhere along the sliver by as
// large a share of its length, here by 1 %.
TEST_P(Trace, MeetsSliversOfAspectAMillion) {
    Device& device = open_variant();
    constexpr int count = 1000;
    constexpr double width = 2e-6;
    const glm::dvec3 along = glm::normalize(glm::dvec3(0.2, 0.3, 1));
    const glm::dvec3 across = glm::normalize(glm::cross(along, glm::dvec3(0, 0.9, 0.1)));
    const glm::dvec3 normal = glm::cross(along, across);
    const auto at = [&](double x, double z) { return glm::vec3(across * x + along * z); };
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const double left = width * (i - count / 2);
        const double right = width * (i + 1 - count / 2);
        mesh.add(at(left, -1), at(right, -1), at(right, 1));
        mesh.add(at(left, -1), at(right, 1), at(left, 1));
    }
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(-0.98, 0.98);
    std::vector<RayRecord> rays;
    std::vector<glm::dvec3> exact;
    for (int i = 0; i < 4000; ++i) {
        const glm::vec3 target = at(share(random) * width * count / 2, share(random));
        const glm::vec3 origin(normal * 2.0 + glm::dvec3(random_point(random)));
        rays.push_back(make_ray(origin, target - origin));
        const double t = glm::dot(glm::dvec3(mesh.corner(0, 0)) - glm::dvec3(origin), normal) /
                         glm::dot(glm::dvec3(target) - glm::dvec3(origin), normal);
        exact.push_back(glm::dvec3(origin) + t * glm::dvec3(target - origin));
    }
    const std::vector<HitRecord> hits = Tracer(device, mesh).closest(rays);
    double worst_along = 0;
    double worst_across = 0;
    std::size_t same = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_NE(hits[i].triangle, no_triangle) << i;
        same += exact_closest(mesh, rays[i]).triangle / 2 == hits[i].triangle / 2 ? 1 : 0;
        worst_along = std::max(worst_along, distance_from(mesh, hits[i], exact[i]));
        const glm::dvec3 corner(mesh.corner(hits[i].triangle, 0));
        worst_across = std::max(worst_across, std::abs(glm::dot(corner - exact[i], across)));
        EXPECT_NEAR(hits[i].t, 1, 0.025) << i;
    }
    EXPECT_LT(worst_across, 1.5 * width);
    EXPECT_LT(worst_along, 0.025 * 2);
    EXPECT_GT(same, rays.size() * 95 / 100) << "in the strip of the exact one";
}

TEST_P(Trace, IsWatertight) {
    Device& device = open_variant();
    const Mesh mesh = bumpy_sphere(40, 0.2f);
    std::mt19937 random(9);
    std::vector<RayRecord> rays;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (const glm::vec3 origin : {glm::vec3(0), 0.3f * random_point(random)}) {
            const glm::vec3 a = mesh.corner(i, 0);
            const glm::vec3 b = mesh.corner(i, 1);
            const glm::vec3 c = mesh.corner(i, 2);
            for (const glm::vec3 target :
                 {a, (a + b) / 2.0f, 0.7f * b + 0.3f * c, (a + b + c) / 3.0f}) {
                rays.push_back(make_ray(origin, target - origin));
            }
        }
    }
    const Tracer tracer(device, mesh);
    std::size_t escaped = 0;
    for (const HitRecord& hit : tracer.closest(rays)) {
        escaped += hit.triangle == no_triangle ? 1 : 0;
    }
    EXPECT_EQ(escaped, 0u);
    EXPECT_THAT(tracer.any(rays), testing::Each(1u));
}

TEST_P(Trace, LeavesSurfacesBehind) {
    Device& device = open_variant();
    for (const float scale : {1.0f, 1e6f, 1e-6f}) {
        Mesh mesh = bumpy_sphere(20, 0);
        for (glm::vec4& position : mesh.positions) {
            position = glm::vec4(scale * glm::vec3(position) + glm::vec3(0.5f * scale), 1);
        }
        const Tracer tracer(device, mesh);
        std::mt19937 random(5);
        std::vector<RayRecord> rays;
        for (int i = 0; i < 3000; ++i) {
            rays.push_back(make_ray(glm::vec3(0.5f * scale) + scale * random_point(random, 0.3f),
                                    random_direction(random)));
        }
        const std::vector<HitRecord> hits = tracer.closest(rays);
        std::vector<RayRecord> outwards;
        std::vector<RayRecord> inwards;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_NE(hits[i].triangle, no_triangle);
            const glm::vec3 a = mesh.corner(hits[i].triangle, 0);
            const glm::vec3 b = mesh.corner(hits[i].triangle, 1);
            const glm::vec3 c = mesh.corner(hits[i].triangle, 2);
            glm::vec3 error;
            const glm::vec3 point = hit_point(a, b, c, hits[i].u, hits[i].v, error);
            const glm::vec3 normal = glm::normalize(glm::cross((b - a) / scale, (c - a) / scale));
            glm::vec3 direction = random_direction(random);
            direction *= glm::dot(direction, normal) < 0 ? -1.0f : 1.0f;
            const glm::vec3 away = offset_ray_origin(point, error, normal, direction);
            outwards.push_back(make_ray(away, direction));
            const glm::vec3 into = offset_ray_origin(point, error, normal, -direction);
            inwards.push_back(make_ray(into, -direction));
        }
        EXPECT_THAT(tracer.any(outwards), testing::Each(0u));
        EXPECT_THAT(tracer.any(inwards), testing::Each(1u));
    }
}

TEST_P(Trace, DoesNotDependOnTheStepLimit) {
    Device& device = open_variant();
    const Tracer tracer(device, random_triangles(3000, 0.3f, 1));
    const std::vector<RayRecord> rays = random_rays(3000, 1, 2);
    const std::vector<HitRecord> hits = tracer.closest(rays);
    const std::vector<std::uint32_t> occluded = tracer.any(rays);
    for (const std::uint32_t limit : {1u, 3u, 20u}) {
        SCOPED_TRACE(limit);
        expect_same(tracer.closest(rays, {.step_limit = limit, .careful = true}), hits);
        EXPECT_EQ(tracer.any(rays, {.step_limit = limit, .careful = true}), occluded);
        expect_same(tracer.closest(rays, {.step_limit = limit, .slots = 100, .careful = true}),
                    hits);
    }
    // Two dispatches are enough for some rays; the others are counted.
    std::uint32_t unfinished = 0;
    const std::vector<HitRecord> found = tracer.closest(rays, {.step_limit = 20}, unfinished);
    std::uint32_t differing = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        differing += found[i].triangle == hits[i].triangle && found[i].t == hits[i].t ? 0 : 1;
    }
    EXPECT_GT(differing, 0u);
    EXPECT_LE(differing, unfinished);
    EXPECT_LT(unfinished, rays.size());
    std::uint32_t with_few_slots = 0;
    tracer.closest(rays, {.step_limit = 20, .slots = 10}, with_few_slots);
    EXPECT_GT(with_few_slots, unfinished);
    std::uint32_t with_enough_steps = 0;
    expect_same(tracer.closest(rays, {.step_limit = 400}, with_enough_steps), hits);
    EXPECT_EQ(with_enough_steps, 0u);
}

TEST_P(Trace, GetsThroughManyCoincidentTrianglesSlow) {
    Device& device = open_variant();
    Mesh mesh;
    for (int i = 0; i < 100'000; ++i) {
        mesh.add({-1, -1, 2}, {1, -1, 2}, {0, 1, 2});
    }
    const Tracer tracer(device, mesh);
    const std::vector<RayRecord> rays(20, make_ray({0, 0, 0}, {0, 0, 1}));
    std::uint32_t unfinished = 0;
    tracer.closest(rays, {}, unfinished);
    EXPECT_EQ(unfinished, rays.size());
    for (const HitRecord& hit : tracer.closest(rays, {.careful = true})) {
        EXPECT_EQ(hit.triangle, 0u);
        EXPECT_EQ(hit.t, 2);
    }
    EXPECT_THAT(tracer.any(rays), testing::Each(1u));
}

INSTANTIATE_VARIANTS(Trace);

using TraceAcross = OneThreadTest;

TEST_F(TraceAcross, VariantsAndThreadsGiveTheSameBits) {
    const Mesh mesh = random_triangles(5000, 0.1f, 1);
    const std::vector<RayRecord> rays = random_rays(5000, 1.2f, 2);
    const std::vector<HitRecord> hits = Tracer(open_with_all_threads(), mesh).closest(rays);
    for (const DeviceSetting& setting : variant_settings()) {
        expect_same(Tracer(shared_devices.get(setting), mesh).closest(rays), hits);
    }
    expect_same(Tracer(open_with_one_thread(), mesh).closest(rays), hits);
}

} // namespace
} // namespace argand
