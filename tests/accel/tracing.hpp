#pragma once

#include "accel/triangle_bvh.hpp"
#include "meshes.hpp"

#include <gtest/gtest.h>
#include <numeric>
#include <optional>
#include <utility>

namespace argand {

struct TraceOptions {
    std::optional<std::uint32_t> step_limit;
    std::optional<std::uint32_t> slots;
    bool careful = false;
};

/// A mesh on a device, ready for rays.
struct Tracer {
    Device& device;
    TriangleBvh bvh;

    Tracer(Device& on, const Mesh& mesh)
        : device(on), bvh(build_triangle_bvh(on, upload(on, "positions", mesh.positions),
                                             upload(on, "triangles", mesh.triangles),
                                             static_cast<std::uint32_t>(mesh.triangles.size()))) {}
    Tracer(Device& on, TriangleBvh built) : device(on), bvh(std::move(built)) {}

    Traversal traversal(std::size_t rays, const TraceOptions& options) const {
        Traversal result = make_traversal(device, rays);
        result.step_limit = options.step_limit.value_or(result.step_limit);
        result.slots = options.slots.value_or(result.slots);
        result.careful = options.careful;
        device.fill(result.unfinished, 0);
        return result;
    }

    std::vector<HitRecord> closest(const std::vector<RayRecord>& rays, const TraceOptions& options,
                                   std::uint32_t& unfinished) const {
        Traversal working = traversal(rays.size(), options);
        const Buffer hits =
            device.allocate("hits", std::max<std::size_t>(rays.size(), 1) * sizeof(HitRecord));
        trace_closest(device, bvh, working,
                      {upload(device, "rays", rays),
                       upload(device, "active", everyone(rays.size())), hits, rays.size()});
        unfinished = download<std::uint32_t>(device, working.unfinished, 1)[0];
        return download<HitRecord>(device, hits, rays.size());
    }
    std::vector<HitRecord> closest(const std::vector<RayRecord>& rays,
                                   const TraceOptions& options = {}) const {
        std::uint32_t unfinished = 0;
        std::vector<HitRecord> hits = closest(rays, options, unfinished);
        EXPECT_EQ(unfinished, 0u);
        return hits;
    }

    /// The closest hits; `hits` holds those behind which rays with a t_max of goes_on go on.
    std::vector<HitRecord> closest_behind(const std::vector<RayRecord>& rays,
                                          const std::vector<HitRecord>& hits,
                                          const TraceOptions& options = {}) const {
        Traversal working = traversal(rays.size(), options);
        const Buffer results = upload(device, "hits", hits);
        trace_closest(device, bvh, working,
                      {upload(device, "rays", rays),
                       upload(device, "active", everyone(rays.size())), results, rays.size()});
        EXPECT_EQ(download<std::uint32_t>(device, working.unfinished, 1)[0], 0u);
        return download<HitRecord>(device, results, rays.size());
    }

    std::vector<std::uint32_t> any(const std::vector<RayRecord>& rays,
                                   const TraceOptions& options = {}) const {
        Traversal working = traversal(rays.size(), options);
        const Buffer occluded = device.allocate("occluded", std::max<std::size_t>(rays.size(), 1) *
                                                                sizeof(std::uint32_t));
        trace_any(device, bvh, working,
                  {upload(device, "rays", rays), upload(device, "active", everyone(rays.size())),
                   occluded, rays.size()});
        EXPECT_EQ(download<std::uint32_t>(device, working.unfinished, 1)[0], 0u);
        return download<std::uint32_t>(device, occluded, rays.size());
    }

    static std::vector<std::uint32_t> everyone(std::size_t count) {
        std::vector<std::uint32_t> indices(count);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }
};

/// What a ray in double precision meets first.
struct ExactHit {
    std::uint32_t triangle = no_triangle;
    double t = 0, u = 0, v = 0;
};

/// Distance and weights (Möller, Trumbore 1997), in double precision; nothing if the triangle is
/// missed.
inline std::optional<glm::dvec3> exact_hit(const Mesh& mesh, std::size_t triangle,
                                           const RayRecord& ray) {
    const glm::dvec3 origin(ray.origin_x, ray.origin_y, ray.origin_z);
    const glm::dvec3 direction(ray.direction_x, ray.direction_y, ray.direction_z);
    const glm::dvec3 a(mesh.corner(triangle, 0));
    const glm::dvec3 ab = glm::dvec3(mesh.corner(triangle, 1)) - a;
    const glm::dvec3 ac = glm::dvec3(mesh.corner(triangle, 2)) - a;
    const glm::dvec3 p = glm::cross(direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0) {
        return {};
    }
    const glm::dvec3 from = origin - a;
    const glm::dvec3 q = glm::cross(from, ab);
    const double u = glm::dot(from, p) / determinant;
    const double v = glm::dot(direction, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || t < 0 || t > double(ray.t_max)) {
        return {};
    }
    return glm::dvec3(t, u, v);
}

/// Sine of the angle between the ray and the triangle's plane.
inline double exact_grazing(const Mesh& mesh, std::size_t triangle, const RayRecord& ray) {
    const glm::dvec3 a(mesh.corner(triangle, 0));
    const glm::dvec3 normal = glm::cross(glm::dvec3(mesh.corner(triangle, 1)) - a,
                                         glm::dvec3(mesh.corner(triangle, 2)) - a);
    const glm::dvec3 direction(ray.direction_x, ray.direction_y, ray.direction_z);
    return std::abs(glm::dot(normal, direction)) / (glm::length(normal) * glm::length(direction));
}

inline ExactHit exact_closest(const Mesh& mesh, const RayRecord& ray) {
    ExactHit closest;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::optional<glm::dvec3> hit = exact_hit(mesh, i, ray);
        if (hit && (closest.triangle == no_triangle || hit->x < closest.t)) {
            closest = {static_cast<std::uint32_t>(i), hit->x, hit->y, hit->z};
        }
    }
    return closest;
}

} // namespace argand
