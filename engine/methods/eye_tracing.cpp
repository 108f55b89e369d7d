#include "methods/eye_tracing.hpp"

#include "kernels/camera_rays.hpp"
#include "kernels/eye_vertex.hpp"
#include "kernels/query_ends.hpp"
#include "kernels/shadow_add.hpp"
#include "parallel/compact.hpp"
#include "shared/alpha.h"

#include <cmath>
#include <utility>

namespace argand {

namespace {

// Vertices recorded before the host looks whether any path is left.
constexpr int vertices_between_checks = 4;

void start_paths(Device& device, EyeWorkspace& w, const Buffer& camera, const EyeBatch& batch) {
    const StageScope stage(device, "camera rays");
    const std::uint32_t slots = batch.pixels * batch.samples;
    dispatch(device,
             kernels::camera_rays{.camera = camera,
                                  .rays = w.rays,
                                  .paths = w.paths,
                                  .layers = w.layers,
                                  .active_slots = w.active,
                                  .eye_weights = w.weights,
                                  .batch = batch,
                                  .constants = {.lattice = w.lattice,
                                                .cones = w.cones,
                                                .cropped = w.cropped,
                                                .filtered = w.filtered,
                                                .weighed = batch.light_paths > 0}},
             slots);
    upload_word(device, w.counts, 0, slots);
}

/// variant_* of shared/path_records.h.
std::uint32_t variant_of(const EyeWorkspace& w, const EyeBatch& batch) {
    return w.queries.final_gather  ? variant_final_gather
           : batch.light_paths > 0 ? variant_light_paths
                                   : variant_plain;
}

/// Shades the vertices that the active paths have reached: leaves shadow rays, queries, and the
/// rays on which the paths continue.
void shade(Device& device, const DeviceScene& scene, EyeWorkspace& w, const EyeBatch& batch,
           bool photon_map) {
    const StageScope stage(device, "shade");
    const Plan& plan = scene.plan;
    dispatch_indirect(
        device,
        kernels::eye_vertex{.scene = scene.bindings(),
                            .texture = scene.texture_bindings(),
                            .hits = w.hits,
                            .active_slots = w.active,
                            .counts = w.counts,
                            .rays = w.rays,
                            .paths = w.paths,
                            .layers = w.layers,
                            .shadow_rays = w.shadow_rays,
                            .shadows = w.shadows,
                            .queries = w.queries.points,
                            .alive = w.alive,
                            .query_kinds = w.queries.kinds,
                            .query_bsdfs = w.queries.bsdfs,
                            .sky = scene.sky,
                            .eye_weights = w.weights,
                            .batch = batch,
                            .constants = {.photon_map = photon_map,
                                          .variant = variant_of(w, batch),
                                          .followed_paths = plan.needs(Feature::followed_paths),
                                          .direct_light = plan.needs(Feature::direct_light),
                                          .glossy_estimates = plan.needs(Feature::glossy_estimates),
                                          .lattice = w.lattice,
                                          .scene = scene.constants(),
                                          .material_features = plan.material_features(),
                                          .texture = scene.texture_constants()}},
        w.counts);
}

/// Whether `occluded` tells thicknesses, of surfaces that let a share of the light pass.
bool tells_thickness(const DeviceScene& scene, const EyeWorkspace& w) {
    return scene.plan.needs(Feature::alpha) || w.tracers.shadow;
}

void add_direct_light(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                      const Count& active) {
    {
        const StageScope stage(device, "trace shadow rays");
        const RayBatch batch{w.shadow_rays, w.active, w.occluded, active};
        if (w.tracers.shadow) {
            w.tracers.shadow(batch, w.hits);
        } else {
            trace_any(device, scene.bvh, w.traversal, batch);
        }
    }
    const StageScope stage(device, "shade");
    dispatch_indirect(device,
                      kernels::shadow_add{.active_slots = w.active,
                                          .counts = w.counts,
                                          .occluded = w.occluded,
                                          .shadows = w.shadows,
                                          .layers = w.layers,
                                          .constants = {.has_alpha = tells_thickness(scene, w)}},
                      w.counts);
}

/// Makes the paths that continue the active ones.
void advance(Device& device, EyeWorkspace& w, const Count& active) {
    const StageScope stage(device, "compact");
    compact(device, w.alive, w.active, w.next_active, {w.counts, 1}, active);
    device.copy(BufferView(w.counts, 4, 4), BufferView(w.counts, 0, 4));
    std::swap(w.active, w.next_active);
}

/// Adds the lights that the last shadow rays found to a list.
void collect_found(Device& device, const DeviceScene& scene, const EyeWorkspace& w,
                   const EyeBatch& batch, std::vector<FoundLight>& found) {
    const bool thickness = tells_thickness(scene, w);
    const std::uint32_t count = download_word(device, w.counts);
    const auto shadows = download<ShadowRecord>(device, w.shadows, w.slots);
    const auto rays = download<RayRecord>(device, w.shadow_rays, w.slots);
    const auto occluded = download<std::uint32_t>(device, w.occluded, w.slots);
    for (const std::uint32_t slot : download<std::uint32_t>(device, w.active, count)) {
        const RayRecord& ray = rays[slot];
        const float passed = thickness             ? transmittance(occluded[slot])
                             : occluded[slot] != 0 ? 0.0f
                                                   : 1.0f;
        if (!(passed > 0) || !(ray.t_max > 0)) {
            continue;
        }
        const ShadowRecord& s = shadows[slot];
        const double radiance = passed * (double(s.estimated_r) + s.estimated_g + s.estimated_b +
                                          s.followed_r + s.followed_g + s.followed_b);
        if (!std::isfinite(radiance)) {
            continue;
        }
        found.push_back({.light = s.light,
                         .pixel = slot / batch.samples,
                         .indirect = (s.layers & 3u) == layer_indirect,
                         .radiance = radiance,
                         .point = {ray.origin_x, ray.origin_y, ray.origin_z},
                         .direction = {-ray.direction_x, -ray.direction_y, -ray.direction_z}});
    }
}

/// Traces the active paths until each has ended or waits for the answer of a query. from_camera:
/// they begin there. Adds the lights that shadow rays find to `found`.
void trace_until_queries(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                         const EyeBatch& batch, bool photon_map, bool from_camera,
                         std::vector<FoundLight>* found) {
    const Count active(w.counts, 0, std::uint64_t(batch.pixels) * batch.samples);
    for (int vertex = 1;; ++vertex) {
        {
            const StageScope stage(device, "trace eye rays");
            const RayBatch rays{w.rays, w.active, w.hits, active};
            if (w.tracers.scattered && !(from_camera && vertex == 1)) {
                w.tracers.scattered(rays);
            } else {
                trace_closest(device, scene.bvh, w.traversal, rays);
            }
        }
        shade(device, scene, w, batch, photon_map);
        if (scene.plan.needs(Feature::direct_light)) {
            add_direct_light(device, scene, w, active);
            if (found != nullptr) {
                collect_found(device, scene, w, batch, *found);
            }
        }
        advance(device, w, active);
        device.submit();
        const bool looks = vertex % vertices_between_checks == 0 || (photon_map && vertex == 1);
        if (looks && download_word(device, w.counts) == 0) {
            break;
        }
    }
}

/// Makes the waiting paths the active ones. Returns whether there are any.
bool find_waiting(Device& device, EyeWorkspace& w, std::uint64_t slots) {
    const StageScope stage(device, "compact");
    compact(device, w.queries.kinds, w.queries.all, w.active, {w.counts, 0}, slots);
    return download_word(device, w.counts) > 0;
}

/// Makes those of the waiting paths that go on the active ones.
void end_waiting(Device& device, EyeWorkspace& w, std::uint64_t slots) {
    {
        const StageScope stage(device, "share queries");
        dispatch_indirect(device,
                          kernels::query_ends{.active_slots = w.active,
                                              .counts = w.counts,
                                              .query_kinds = w.queries.kinds,
                                              .alive = w.alive},
                          w.counts);
    }
    advance(device, w, Count(w.counts, 0, slots));
}

} // namespace

void trace_paths(Device& device, const DeviceScene& scene, EyeWorkspace& w, const Buffer& camera,
                 const EyeBatch& batch, const PhotonLookup* lookup,
                 std::vector<FoundLight>* found) {
    const std::uint64_t slots = std::uint64_t(batch.pixels) * batch.samples;
    device.fill(w.traversal.unfinished, 0);
    start_paths(device, w, camera, batch);
    if (lookup == nullptr) {
        trace_until_queries(device, scene, w, batch, false, true, found);
        return;
    }
    device.fill(w.queries.kinds, 0);
    for (bool first = true;; first = false) {
        trace_until_queries(device, scene, w, batch, true, first, found);
        if (!find_waiting(device, w, slots)) {
            return;
        }
        answer_queries(device, scene.plan, w.queries,
                       {.slots = w.active,
                        .counts = w.counts,
                        .most = slots,
                        .layers = w.layers,
                        .records = w.paths,
                        .bounces = batch.bounces,
                        .first = first,
                        .traversal = w.traversal},
                       *lookup);
        end_waiting(device, w, slots);
        if (download_word(device, w.counts) == 0) {
            return;
        }
    }
}

} // namespace argand
