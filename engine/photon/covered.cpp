#include "photon/covered.hpp"

#include "kernels/area_cover.hpp"
#include "kernels/area_rays.hpp"
#include "kernels/photon_cover.hpp"
#include "kernels/photon_cover_rays.hpp"
#include "kernels/view_link_rays.hpp"
#include "kernels/view_link_search.hpp"
#include "kernels/view_links.hpp"
#include "parallel/compact.hpp"
#include "shared/bsdf.h"

#include <algorithm>
#include <utility>

namespace argand {

namespace {

/// Makes all `params.count` places of a batch, which has begun, the active ones. Returns the
/// counter for the number of those that go_on() keeps.
template <class Params>
std::uint32_t begin_rounds(Device& device, PhotonWorkspace& w, Params& params) {
    params.counter = counter_active;
    upload_word(device, w.counters, params.counter, params.count);
    return counter_next_active;
}

/// Makes the places whose rays go on the active ones.
template <class Params>
void go_on(Device& device, PhotonWorkspace& w, Params& params, std::uint32_t& next_counter) {
    compact(device, w.alive, w.active, w.next_active, {w.counters, next_counter},
            Count(w.counters, params.counter, params.count));
    std::swap(w.active, w.next_active);
    std::swap(params.counter, next_counter);
}

/// Traces the short rays of `count` places in batches. write_rays and look: kernels that write a
/// batch's rays, and that look at their hits, with its parameters; they hold what all batches
/// share. Rays that go on behind a surface make up the next round.
template <class Params, class WriteRays, class Look>
void trace_to_places(Device& device, const DeviceScene& scene, PhotonWorkspace& w,
                     std::uint64_t count, Params params, const WriteRays& write_rays,
                     const Look& look) {
    // Rays go on behind both faces of a pane.
    const bool some_pass =
        (scene.plan.material_features() & (LOBE_TRANSMIT | LOBE_CLEAR | MATERIAL_ALPHA)) != 0;
    const int surfaces = some_pass ? 3 : 1;
    params.error = position_error(scene.record);
    for (std::uint64_t first = 0; first < count; first += w.slots) {
        params.first = static_cast<std::uint32_t>(first);
        params.count = static_cast<std::uint32_t>(std::min(w.slots, count - first));
        dispatch(device, write_rays(params), params.count);
        std::uint32_t next_counter = begin_rounds(device, w, params);
        for (int surface = 0; surface < surfaces; ++surface) {
            const Count rays(w.counters, params.counter, params.count);
            trace_closest(device, scene.bvh, w.traversal, {w.rays, w.active, w.hits, rays});
            dispatch(device, look(params), rays);
            if (surface + 1 < surfaces) {
                go_on(device, w, params, next_counter);
            }
        }
    }
}

/// Calls `drop`, and once more and with care if a ray of it ran out of iterations: what was dropped
/// stays dropped.
template <class Drop> void drop_with_care(Device& device, PhotonWorkspace& w, const Drop& drop) {
    device.fill(w.traversal.unfinished, 0);
    drop();
    if (!w.traversal.careful && download_word(device, w.traversal.unfinished) > 0) {
        w.traversal.careful = true;
        drop();
        w.traversal.careful = false;
    }
}

/// Writes the next rays of the places of this batch that view_links marked. next_counter: that
/// holds their number.
void search_links(Device& device, PhotonWorkspace& w, const ViewPoints& view,
                  ViewLinkParams& params, std::uint32_t& next_counter) {
    go_on(device, w, params, next_counter);
    dispatch(device,
             kernels::view_link_search{.photons = w.photons,
                                       .counters = w.counters,
                                       .view_points = view.table,
                                       .rays = w.rays,
                                       .active_slots = w.active,
                                       .unlinked_cells = view.unlinked,
                                       .params = params},
             Count(w.counters, params.counter, params.count));
}

/// Traces the rays of a batch of places to points in view.
void drop_unlinked_batch(Device& device, const DeviceScene& scene, PhotonWorkspace& w,
                         const ViewPoints& view, ViewLinkParams params) {
    constexpr int further_rays = 3; // of a place whose first is blocked
    dispatch(device,
             kernels::view_link_rays{.photons = w.photons,
                                     .counters = w.counters,
                                     .view_points = view.table,
                                     .rays = w.rays,
                                     .active_slots = w.active,
                                     .tested_cells = params.sides == 2 ? view.near : view.unlinked,
                                     .params = params},
             params.count);
    std::uint32_t next_counter = begin_rounds(device, w, params);
    for (int ray = 0; ray <= further_rays; ++ray) { // the first is in the place's own cell, or none
        if (ray > 0) {
            params.searches = static_cast<std::uint32_t>(ray - 1);
            search_links(device, w, view, params, next_counter);
        }
        const Count rays(w.counters, params.counter, params.count);
        trace_closest(device, scene.bvh, w.traversal, {w.rays, w.active, w.hits, rays});
        params.last = ray == further_rays ? 1 : 0;
        dispatch(
            device,
            kernels::view_links{.triangles = scene.triangles,
                                .materials = scene.materials,
                                .hits = w.hits,
                                .counters = w.counters,
                                .photons = w.photons,
                                .rays = w.rays,
                                .active_slots = w.active,
                                .alive = w.alive,
                                .unlinked_cells = view.unlinked,
                                .params = params,
                                .constants = {.material_features = scene.plan.material_features()}},
            rays);
    }
}

void drop_unlinked(Device& device, const DeviceScene& scene, PhotonWorkspace& w,
                   std::uint64_t count, std::uint32_t sides, const ViewPoints& view,
                   const SampledPart& corrected) {
    const glm::vec3 center(corrected.center);
    ViewLinkParams params{
        .sides = sides,
        .cells = static_cast<float>(1 / view.cell),
        .mask = static_cast<std::uint32_t>(view.table.size() / sizeof(ViewPointRecord) - 1),
        .error = position_error(scene.record),
        .corrected_x = center.x,
        .corrected_y = center.y,
        .corrected_z = center.z,
        .corrected_distance = static_cast<float>(corrected.reach)};
    drop_with_care(device, w, [&] {
        for (std::uint64_t first = 0; first < count; first += w.slots) {
            params.first = static_cast<std::uint32_t>(first);
            params.count = static_cast<std::uint32_t>(std::min(w.slots, count - first));
            drop_unlinked_batch(device, scene, w, view, params);
        }
    });
}

} // namespace

SampledPart corrected_part(const SampledPart& sampled) {
    constexpr double inner_share = 0.9;
    return {sampled.center, inner_share * sampled.reach};
}

void drop_covered_areas(Device& device, const DeviceScene& scene, PhotonWorkspace& w,
                        std::uint32_t samples, double height) {
    const auto write_rays = [&](const AreaCoverParams& params) {
        return kernels::area_rays{.counters = w.counters,
                                  .photons = w.photons,
                                  .rays = w.rays,
                                  .active_slots = w.active,
                                  .params = params};
    };
    const auto look = [&](const AreaCoverParams& params) {
        return kernels::area_cover{
            .triangles = scene.triangles,
            .materials = scene.materials,
            .hits = w.hits,
            .counters = w.counters,
            .photons = w.photons,
            .positions = scene.positions,
            .rays = w.rays,
            .active_slots = w.active,
            .alive = w.alive,
            .params = params,
            .constants = {.material_features = scene.plan.material_features()}};
    };
    drop_with_care(device, w, [&] {
        trace_to_places(device, scene, w, 2 * std::uint64_t(samples),
                        AreaCoverParams{.height = static_cast<float>(height)}, write_rays, look);
    });
}

void drop_covered_photons(Device& device, const DeviceScene& scene, PhotonWorkspace& w,
                          std::uint64_t slots, double height, const SampledPart& corrected) {
    const auto write_rays = [&](const PhotonCoverParams& params) {
        return kernels::photon_cover_rays{
            .photons = w.photons, .rays = w.rays, .active_slots = w.active, .params = params};
    };
    const auto look = [&](const PhotonCoverParams& params) {
        return kernels::photon_cover{
            .triangles = scene.triangles,
            .materials = scene.materials,
            .hits = w.hits,
            .photons = w.photons,
            .rays = w.rays,
            .counters = w.counters,
            .active_slots = w.active,
            .alive = w.alive,
            .params = params,
            .constants = {.material_features = scene.plan.material_features()}};
    };
    const glm::vec3 center(corrected.center);
    const PhotonCoverParams params{.height = static_cast<float>(height),
                                   .corrected_x = center.x,
                                   .corrected_y = center.y,
                                   .corrected_z = center.z,
                                   .corrected_distance = static_cast<float>(corrected.reach)};
    drop_with_care(device, w,
                   [&] { trace_to_places(device, scene, w, slots, params, write_rays, look); });
}

void drop_unlinked_areas(Device& device, const DeviceScene& scene, PhotonWorkspace& w,
                         std::uint32_t samples, const ViewPoints& view,
                         const SampledPart& corrected) {
    device.fill(view.unlinked, 0);
    drop_unlinked(device, scene, w, 2 * std::uint64_t(samples), 2, view, corrected);
}

void drop_unlinked_photons(Device& device, const DeviceScene& scene, PhotonWorkspace& w,
                           std::uint64_t slots, const ViewPoints& view,
                           const SampledPart& corrected) {
    drop_unlinked(device, scene, w, slots, 1, view, corrected);
}

} // namespace argand
