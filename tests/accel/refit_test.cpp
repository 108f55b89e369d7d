// Trees that follow moving triangles: rays must hit what they hit in a tree that is built anew.
#include "device_fixture.hpp"
#include "shared/accel_records.h"
#include "tracing.hpp"

#include <cmath>
#include <random>
#include <span>
#include <utility>

namespace argand {
namespace {

using Refit = VariantTest;

/// A mesh whose tree follows it.
class Moving {
public:
    Moving(Device& device, const Mesh& mesh)
        : device_(device), positions_(upload(device, "positions", mesh.positions)),
          triangles_(upload(device, "triangles", mesh.triangles)),
          tracer(device,
                 build_triangle_bvh(device, positions_, triangles_,
                                    static_cast<std::uint32_t>(mesh.triangles.size()), true)) {}

    void follow(const Mesh& mesh) {
        if (!mesh.positions.empty()) {
            device_.upload(positions_, 0, std::as_bytes(std::span(mesh.positions)));
            device_.upload(triangles_, 0, std::as_bytes(std::span(mesh.triangles)));
        }
        refit_triangle_bvh(device_, tracer.bvh, positions_, triangles_);
    }

private:
    Device& device_;
    Buffer positions_, triangles_;

public:
    Tracer tracer;
};

/// Every ray hits the same, to the bit, as in a tree that is built for the mesh.
void expect_as_fresh(Device& device, const Moving& moving, const Mesh& mesh, std::size_t count) {
    const std::vector<RayRecord> rays = random_rays(count, 2, 9);
    const Tracer fresh(device, mesh);
    const std::vector<HitRecord> a = moving.tracer.closest(rays), b = fresh.closest(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_TRUE(a[i].triangle == b[i].triangle && a[i].t == b[i].t && a[i].u == b[i].u &&
                    a[i].v == b[i].v)
            << i;
    }
    EXPECT_EQ(moving.tracer.any(rays), fresh.any(rays));
}

/// Moves every vertex.
template <class Move> Mesh moved(Mesh mesh, const Move& move) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.positions[i] = glm::vec4(move(i, glm::vec3(mesh.positions[i])), 1);
    }
    return mesh;
}

TEST_P(Refit, HitsWhatAFreshTreeHits) {
    Device& device = open_variant();
    for (const std::size_t count : {0, 1, 2, 3, 17, 1000}) {
        SCOPED_TRACE(count);
        const Mesh mesh = random_triangles(count, 0.2f, 3);
        Moving moving(device, mesh);
        expect_as_fresh(device, moving, mesh, 500);
        std::mt19937 random(5);
        const std::vector<Mesh> places = {
            moved(mesh, [](std::size_t, glm::vec3 p) { return p + glm::vec3(0, 0.5f * p.x, 0); }),
            moved(mesh, [](std::size_t, glm::vec3 p) { return 40.0f * p + glm::vec3(3); }),
            moved(mesh, [](std::size_t, glm::vec3 p) { return glm::vec3(p.x, p.y, 0); }),
            // Every third triangle shrinks to nothing.
            moved(mesh,
                  [&](std::size_t i, glm::vec3 p) {
                      return i / 3 % 3 == 0 ? glm::vec3(mesh.positions[i / 3 * 3]) : p;
                  }),
            // All in one place, then everywhere.
            moved(mesh, [](std::size_t, glm::vec3) { return glm::vec3(0.25f); }),
            moved(mesh, [&](std::size_t, glm::vec3) { return random_point(random); }), mesh};
        for (const Mesh& place : places) {
            moving.follow(place);
            expect_as_fresh(device, moving, place, 500);
        }
    }
}

TEST_P(Refit, WritesWhatTheBuildWrites) {
    Device& device = open_variant();
    for (const std::uint32_t count : {2u, 3u, 5u, 333u}) {
        const Mesh mesh = random_triangles(count, 0.2f, 3);
        const Buffer positions = upload(device, "positions", mesh.positions),
                     triangles = upload(device, "triangles", mesh.triangles);
        const auto words = [&](bool moves) {
            const TriangleBvh bvh = build_triangle_bvh(device, positions, triangles, count, moves);
            // Of the nodes at least a third of `count` exists.
            std::vector<std::uint32_t> all =
                download<std::uint32_t>(device, bvh.nodes, (count + 2) / 3 * sizeof(RayNode) / 4);
            const auto leaves =
                download<std::uint32_t>(device, bvh.triangles, count * sizeof(RayTriangle) / 4);
            all.insert(all.end(), leaves.begin(), leaves.end());
            return all;
        };
        EXPECT_EQ(words(true), words(false)) << count;
    }
}

TEST_P(Refit, FollowsTrianglesThatAreTurned) {
    Device& device = open_variant();
    Mesh mesh = bumpy_sphere(9, 0.2f);
    Moving moving(device, mesh);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 2) {
        std::swap(mesh.triangles[i].y, mesh.triangles[i].z);
    }
    moving.follow(mesh);
    expect_as_fresh(device, moving, mesh, 500);
}

TEST_P(Refit, DoesNotWearOutInAThousandFrames) {
    Device& device = open_variant();
    const Mesh mesh = bumpy_sphere(8, 0.1f);
    Moving moving(device, mesh);
    Mesh now = mesh;
    for (int frame = 1; frame <= 1000; ++frame) {
        now = moved(mesh, [&](std::size_t, glm::vec3 p) {
            return p * (1 + 0.9f * std::sin(0.07f * static_cast<float>(frame) + 3 * p.z));
        });
        moving.follow(now);
    }
    expect_as_fresh(device, moving, now, 1000);
    moving.follow(mesh);
    expect_as_fresh(device, moving, mesh, 1000);
}

TEST_P(Refit, CostTellsHowFarTrianglesHaveMoved) {
    Device& device = open_variant();
    const Mesh mesh = random_triangles(2000, 0.05f, 4);
    Moving moving(device, mesh);
    const double cost = traversal_cost(device, moving.tracer.bvh);
    EXPECT_GT(cost, 0);
    moving.follow(mesh);
    EXPECT_EQ(traversal_cost(device, moving.tracer.bvh), cost);
    // As a whole: areas grow, but no more than that.
    moving.follow(moved(mesh, [](std::size_t, glm::vec3 p) { return 4.0f * p; }));
    EXPECT_NEAR(traversal_cost(device, moving.tracer.bvh) / cost, 16, 1e-3);
    moving.follow(moved(mesh, [](std::size_t, glm::vec3 p) { return p + glm::vec3(4, 0, 0); }));
    EXPECT_NEAR(traversal_cost(device, moving.tracer.bvh) / cost, 1, 1e-3);
    // Neighbours part.
    const auto scatter = [](std::size_t i, glm::vec3 p) {
        return p + (i / 3 % 2 == 0 ? glm::vec3(0) : glm::vec3(1, 0, 0));
    };
    moving.follow(moved(mesh, scatter));
    EXPECT_GT(traversal_cost(device, moving.tracer.bvh), 1.3 * cost);
    EXPECT_EQ(traversal_cost(device, Moving(device, Mesh()).tracer.bvh), 0);
    EXPECT_EQ(traversal_cost(device, Moving(device, random_triangles(1, 1, 1)).tracer.bvh), 0);
}

INSTANTIATE_VARIANTS(Refit);

} // namespace
} // namespace argand
