#include "bench_rays.hpp"

#include "accel/triangle_bvh.hpp"
#include "bench_scene.hpp"
#include "embree_peer.hpp"
#include "shared/geometry_records.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace argand {

namespace {

constexpr std::uint32_t edge = 1024; // of the square image

void nothing() {}

std::vector<RayRecord> records(const BenchRays& rays) {
    std::vector<RayRecord> result(rays.origins.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const glm::vec3 o = rays.origins[i];
        const glm::vec3 d = rays.directions[i];
        result[i] = {o.x, o.y, o.z, rays.ends[i], d.x, d.y, d.z, 0};
    }
    return result;
}

BenchRow make_row(std::string name, std::uint64_t n, double seconds, std::string unit) {
    return {.name = std::move(name),
            .n = n,
            .seconds = seconds,
            .rate = double(n) / seconds,
            .unit = std::move(unit)};
}

struct RayBench {
    Device& device;
    const EmbreePeer& peer;
    TriangleBvh bvh;
    Traversal traversal;
    Buffer active;

    BenchRow any(const std::string& name, const BenchRays& rays) {
        const std::uint64_t n = rays.origins.size();
        const Buffer uploaded = upload(device, "bench rays", records(rays));
        const Buffer occluded = device.allocate("bench occluded", n * sizeof(std::uint32_t));
        const double seconds = median_device_seconds(device, nothing, [&] {
            trace_any(device, bvh, traversal, {uploaded, active, occluded, n});
        });
        return with_peer(make_row(name, n, seconds, "rays/s"), EmbreePeer::occluded_name,
                         peer.occluded_rate(rays));
    }

    BenchRow closest(const std::string& name, const BenchRays& rays,
                     std::vector<HitRecord>& found) {
        const std::uint64_t n = rays.origins.size();
        const Buffer uploaded = upload(device, "bench rays", records(rays));
        const Buffer hits = device.allocate("bench hits", n * sizeof(HitRecord));
        const double seconds = median_device_seconds(device, nothing, [&] {
            trace_closest(device, bvh, traversal, {uploaded, active, hits, n});
        });
        found = download<HitRecord>(device, hits, n);
        return with_peer(make_row(name, n, seconds, "rays/s"), EmbreePeer::closest_name,
                         peer.closest_rate(rays));
    }

    static BenchRow with_peer(BenchRow row, const char* name, double rate) {
        if (rate > 0) {
            row.peer = name;
            row.peer_rate = rate;
        }
        return row;
    }
};

/// One ray per hit, in a cosine-distributed direction or towards the light.
struct Bounces {
    BenchRays diffuse;
    BenchRays shadow;
};

Bounces bounce(const BenchScene& scene, const BenchRays& rays, const std::vector<HitRecord>& hits) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform;
    Bounces result;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const float azimuth = 2 * float(M_PI) * uniform(random);
        const float square = uniform(random);
        glm::vec3 origin = rays.origins[i];
        glm::vec3 direction = rays.directions[i];
        glm::vec3 to_light(0, 0, 1);
        float end = -1; // a miss gets no ray
        if (hits[i].triangle != no_triangle) {
            const glm::uvec4 triangle = scene.triangles[hits[i].triangle];
            const glm::vec3 a(scene.positions[triangle.x]);
            glm::vec3 normal =
                glm::normalize(glm::cross(glm::vec3(scene.positions[triangle.y]) - a,
                                          glm::vec3(scene.positions[triangle.z]) - a));
            normal *= glm::dot(normal, direction) > 0 ? -1.0f : 1.0f;
            const glm::vec3 side =
                glm::normalize(std::abs(normal.x) > 0.5f ? glm::vec3(normal.y, -normal.x, 0)
                                                         : glm::vec3(0, normal.z, -normal.y));
            origin += hits[i].t * direction + 1e-4f * normal;
            direction = std::sqrt(square) * (std::cos(azimuth) * side +
                                             std::sin(azimuth) * glm::cross(normal, side)) +
                        std::sqrt(1 - square) * normal;
            to_light = scene.light - origin;
            end = 1;
        }
        result.diffuse.origins.push_back(origin);
        result.diffuse.directions.push_back(direction);
        result.diffuse.ends.push_back(end * far_away);
        result.shadow.origins.push_back(origin);
        result.shadow.directions.push_back(to_light);
        result.shadow.ends.push_back(end * 0.999f);
    }
    return result;
}

} // namespace

std::vector<BenchRow> bench_rays(Device& device) {
    const BenchScene scene = make_bench_scene();
    const EmbreePeer peer(scene);
    const Buffer positions = upload(device, "bench positions", scene.positions);
    const Buffer triangles = upload(device, "bench triangles", scene.triangles);
    const auto count = static_cast<std::uint32_t>(scene.triangles.size());
    std::vector<BenchRow> rows;

    TriangleBvh bvh;
    const double seconds = median_device_seconds(
        device, nothing, [&] { bvh = build_triangle_bvh(device, positions, triangles, count); });
    rows.push_back(make_row("bvh build", count, seconds, "triangles/s"));
    const TriangleBvh moving = build_triangle_bvh(device, positions, triangles, count, true);
    const double refit_seconds = median_device_seconds(
        device, nothing, [&] { refit_triangle_bvh(device, moving, positions, triangles); });
    rows.push_back(make_row("bvh refit", count, refit_seconds, "triangles/s"));
    TriangleBvh kdtree;
    const double kdtree_seconds = median_device_seconds(device, nothing, [&] {
        kdtree = build_triangle_kdtree(device, positions, triangles, count, {});
    });
    rows.push_back(make_row("kd-tree build", count, kdtree_seconds, "triangles/s"));

    std::vector<std::uint32_t> all_rays(std::uint64_t(edge) * edge);
    std::iota(all_rays.begin(), all_rays.end(), 0u);
    RayBench bench{device, peer, bvh, make_traversal(device, all_rays.size()),
                   upload(device, "bench active", all_rays)};
    device.fill(bench.traversal.unfinished, 0);
    const BenchRays primary = primary_rays(scene, edge);
    std::vector<HitRecord> hits;
    rows.push_back(bench.closest("primary rays", primary, hits));
    const Bounces bounces = bounce(scene, primary, hits);
    rows.push_back(bench.any("shadow rays", bounces.shadow));
    rows.push_back(bench.closest("diffuse rays", bounces.diffuse, hits));
    bench.bvh = kdtree;
    rows.push_back(bench.closest("primary rays, kd-tree", primary, hits));
    rows.push_back(bench.any("shadow rays, kd-tree", bounces.shadow));
    rows.push_back(bench.closest("diffuse rays, kd-tree", bounces.diffuse, hits));
    return rows;
}

} // namespace argand
