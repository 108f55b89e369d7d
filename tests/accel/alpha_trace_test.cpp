// Rays past surfaces of which a part is absent.
#include "device_fixture.hpp"
#include "scene/scene.hpp"
#include "shared/alpha.h"
#include "shared/material_record.h"
#include "shared/scene_records.h"
#include "tracing.hpp"

#include <cstring>

namespace argand {
namespace {

/// Gives the triangles of a mesh materials with these coverages, by turns.
void set_coverages(Device& device, Mesh& mesh, const std::vector<float>& coverages,
                   TriangleBvh& bvh) {
    std::vector<MaterialRecord> materials(coverages.size());
    for (std::size_t i = 0; i < coverages.size(); ++i) {
        materials[i].coverage = coverages[i];
    }
    const Buffer none = device.allocate("none", 16);
    bvh.alpha = {.scene = upload(device, "scene", std::vector<SceneRecord>(1)),
                 .triangles = upload(device, "corners", mesh.triangles),
                 .materials = upload(device, "materials", materials),
                 .attributes = none,
                 .textures = none,
                 .texels = none};
}

Mesh with_materials(Mesh mesh, std::size_t count) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        mesh.triangles[i].w = static_cast<std::uint32_t>(i % count);
    }
    return mesh;
}

/// Rays through the four-wide tree and through a kd-tree.
struct Tracers {
    Tracer wide, kdtree;

    Tracers(Device& device, Mesh mesh, const std::vector<float>& coverages)
        : wide(device, mesh),
          kdtree(device,
                 build_triangle_kdtree(device, upload(device, "positions", mesh.positions),
                                       upload(device, "triangles", mesh.triangles),
                                       static_cast<std::uint32_t>(mesh.triangles.size()), {})) {
        set_coverages(device, mesh, coverages, wide.bvh);
        set_coverages(device, mesh, coverages, kdtree.bvh);
    }
};

using AlphaTrace = VariantTest;

const std::vector<float> some_coverages = {0.5f, 0.25f, 0.0f, 0.875f, 0.01f};

TEST_P(AlphaTrace, ShadowRaysMultiplyByWhatIsAbsent) {
    Device& device = open_variant();
    for (const std::size_t count : {1, 2, 33, 400}) {
        SCOPED_TRACE(count);
        std::vector<float> coverages = some_coverages;
        coverages.push_back(count < 400 ? 1.0f : 0.5f); // opaque ones hide the rest
        const Mesh mesh = with_materials(random_triangles(count, 0.5f, 1), coverages.size());
        const std::vector<RayRecord> rays = random_rays(1000, 1.5f, 2);
        const Tracers tracers(device, mesh, coverages);
        const std::vector<std::uint32_t> thickness = tracers.wide.any(rays);
        EXPECT_EQ(tracers.kdtree.any(rays), thickness);
        std::size_t differing = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            double passed = 1;
            for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
                passed *=
                    exact_hit(mesh, k, rays[i]) ? 1 - double(coverages[mesh.triangles[k].w]) : 1;
            }
            differing +=
                std::abs(double(transmittance(thickness[i])) - passed) > 1e-6 * passed ? 1 : 0;
        }
        EXPECT_LE(differing, 2u); // passes within rounding of an edge
    }
}

// Each ray goes on behind what it has hit, and so meets all surfaces in their order.
TEST_P(AlphaTrace, RaysGoOnBehindWhatTheyHit) {
    Device& device = open_variant();
    const Mesh mesh = with_materials(random_triangles(200, 0.6f, 3), some_coverages.size());
    std::vector<RayRecord> rays = random_rays(500, 1.5f, 4);
    for (RayRecord& ray : rays) {
        ray.t_max = far_away;
    }
    const std::vector<RayRecord> first = rays;
    const Tracers tracers(device, mesh, some_coverages);
    std::vector<std::vector<std::uint32_t>> met(rays.size());
    std::vector<HitRecord> last(rays.size());
    for (bool any = true; any;) {
        any = false;
        const std::vector<HitRecord> hits = tracers.wide.closest_behind(rays, last);
        const std::vector<HitRecord> again = tracers.kdtree.closest_behind(rays, last);
        const TraceOptions in_steps{.step_limit = 40, .careful = true};
        const std::vector<HitRecord> resumed = tracers.wide.closest_behind(rays, last, in_steps);
        const std::vector<HitRecord> resumed_again =
            tracers.kdtree.closest_behind(rays, last, in_steps);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            for (const auto* others : {&again, &resumed, &resumed_again}) {
                ASSERT_EQ(std::memcmp(&hits[i], &(*others)[i], sizeof(HitRecord)), 0) << i;
            }
            if (hits[i].triangle == no_triangle) {
                rays[i].t_max = -1;
                continue;
            }
            any = true;
            met[i].push_back(hits[i].triangle);
            rays[i].t_max = goes_on;
        }
        last = hits;
    }
    std::size_t differing = 0, layers = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        std::vector<std::pair<double, std::uint32_t>> expected;
        for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
            const auto hit = exact_hit(mesh, k, first[i]);
            if (hit && some_coverages[mesh.triangles[k].w] > 0) {
                expected.emplace_back(hit->x, k);
            }
        }
        std::sort(expected.begin(), expected.end());
        bool same = expected.size() == met[i].size();
        for (std::size_t k = 0; same && k < expected.size(); ++k) {
            same = expected[k].second == met[i][k];
        }
        differing += same ? 0 : 1;
        layers = std::max(layers, met[i].size());
    }
    EXPECT_LE(differing, 3u);
    EXPECT_GT(layers, 5u);
}

/// A level grid of squares with shared vertices, of two triangles each, with diagonals both ways.
Mesh grid(std::uint32_t squares, glm::vec3 scale) {
    Mesh mesh;
    for (std::uint32_t y = 0; y <= squares; ++y) {
        for (std::uint32_t x = 0; x <= squares; ++x) {
            const float height = 0.02f * float((3 * x + 5 * y) % 7);
            mesh.positions.emplace_back(glm::vec3(x, y, height) * scale, 1);
        }
    }
    for (std::uint32_t y = 0; y < squares; ++y) {
        for (std::uint32_t x = 0; x < squares; ++x) {
            const std::uint32_t a = y * (squares + 1) + x, b = a + 1, c = a + squares + 1,
                                d = c + 1;
            if ((x + y) % 2 == 0) {
                mesh.triangles.emplace_back(a, b, d, 0);
                mesh.triangles.emplace_back(d, c, a, 0); // turned the other way
            } else {
                mesh.triangles.emplace_back(b, a, c, 0);
                mesh.triangles.emplace_back(c, d, b, 0);
            }
        }
    }
    return mesh;
}

// A ray through an edge or a vertex crosses the surface once, whichever triangles meet there.
TEST_P(AlphaTrace, CountsSharedEdgesOnce) {
    Device& device = open_variant();
    constexpr std::uint32_t squares = 8;
    for (const glm::vec3 direction : {glm::vec3(0, 0, -1), glm::vec3(0.25f, -0.5f, -1)}) {
        for (const glm::vec3 scale : {glm::vec3(1), glm::vec3(1, 0.3f, 1), glm::vec3(-1, 1, 1)}) {
            const Mesh mesh = grid(squares, scale);
            std::vector<RayRecord> rays;
            // Quarters of squares: vertices, edges, diagonals and what lies between.
            for (std::uint32_t y = 4; y <= 4 * (squares - 1); ++y) {
                for (std::uint32_t x = 4; x <= 4 * (squares - 1); ++x) {
                    const std::uint32_t column = x / 4, row = y / 4;
                    glm::vec3 to = glm::vec3(mesh.positions[row * (squares + 1) + column]);
                    to.x = 0.25f * float(x) * scale.x;
                    to.y = 0.25f * float(y) * scale.y;
                    const glm::vec3 from = to - 4.0f * direction;
                    rays.push_back({from.x, from.y, from.z, far_away, direction.x, direction.y,
                                    direction.z, 0});
                }
            }
            const Tracers tracers(device, mesh, {0.5f});
            const std::uint32_t once = thickness_of(0.5f);
            EXPECT_THAT(tracers.wide.any(rays), ::testing::Each(once));
            EXPECT_THAT(tracers.kdtree.any(rays), ::testing::Each(once));
            std::vector<HitRecord> hits = tracers.wide.closest(rays);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                ASSERT_NE(hits[i].triangle, no_triangle) << i;
                rays[i].t_max = goes_on;
            }
            for (const HitRecord& hit : tracers.wide.closest_behind(rays, hits)) {
                ASSERT_EQ(hit.triangle, no_triangle);
            }
        }
    }
}

TEST_P(AlphaTrace, ResumesRays) {
    Device& device = open_variant();
    const Mesh mesh = with_materials(random_triangles(300, 0.5f, 1), 2);
    const std::vector<RayRecord> rays = random_rays(100, 1.5f, 2);
    const Tracers tracers(device, mesh, {0.1f, 0.2f});
    const std::vector<std::uint32_t> thickness = tracers.wide.any(rays);
    const std::vector<HitRecord> hits = tracers.wide.closest(rays);
    for (const std::uint32_t limit : {15u, 100u}) {
        const TraceOptions options{.step_limit = limit, .careful = true};
        EXPECT_EQ(tracers.wide.any(rays, options), thickness);
        EXPECT_EQ(tracers.kdtree.any(rays, options), thickness);
        for (const Tracer* tracer : {&tracers.wide, &tracers.kdtree}) {
            const std::vector<HitRecord> found = tracer->closest(rays, options);
            EXPECT_EQ(std::memcmp(found.data(), hits.data(), hits.size() * sizeof(HitRecord)), 0);
        }
    }
}

TEST_P(AlphaTrace, OpaqueSurfacesStayWhatTheyAre) {
    Device& device = open_variant();
    const Mesh mesh = random_triangles(300, 0.3f, 1);
    const std::vector<RayRecord> rays = random_rays(1000, 1.5f, 2);
    const Tracer plain(device, mesh);
    const Tracers tracers(device, mesh, {1.0f});
    const std::vector<HitRecord> hits = plain.closest(rays);
    const std::vector<std::uint32_t> occluded = plain.any(rays);
    for (const Tracer* tracer : {&tracers.wide, &tracers.kdtree}) {
        const std::vector<HitRecord> found = tracer->closest(rays);
        EXPECT_EQ(std::memcmp(found.data(), hits.data(), hits.size() * sizeof(HitRecord)), 0);
        const std::vector<std::uint32_t> thickness = tracer->any(rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_EQ(thickness[i], occluded[i] != 0 ? thickness_of_all : 0u);
        }
    }
}

TEST_P(AlphaTrace, TakesNoRayAndNoTriangle) {
    Device& device = open_variant();
    EXPECT_TRUE(Tracers(device, random_triangles(3, 1, 1), {0.5f}).wide.any({}).empty());
    const Tracers empty(device, Mesh{}, {0.5f});
    const std::vector<RayRecord> rays = random_rays(10, 1, 1);
    EXPECT_THAT(empty.wide.any(rays), ::testing::Each(0u));
    EXPECT_THAT(empty.kdtree.any(rays), ::testing::Each(0u));
}

INSTANTIATE_VARIANTS(AlphaTrace);

} // namespace
} // namespace argand
