#include "photon/covered.hpp"

#include "kernels/area_cover.hpp"
#include "kernels/area_rays.hpp"
#include "kernels/photon_cover.hpp"
#include "kernels/photon_cover_rays.hpp"
#include "parallel/compact.hpp"
#include "shared/bsdf.h"

#include <algorithm>
#include <utility>

namespace argand {

namespace {

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
    device.fill(w.traversal.unfinished, 0);
    for (std::uint64_t first = 0; first < count; first += w.slots) {
        params.first = static_cast<std::uint32_t>(first);
        params.count = static_cast<std::uint32_t>(std::min(w.slots, count - first));
        dispatch(device, write_rays(params), params.count);
        params.counter = counter_active;
        std::uint32_t next_counter = counter_next_active;
        upload_word(device, w.counters, params.counter, params.count);
        for (int surface = 0; surface < surfaces; ++surface) {
            const Count rays(w.counters, params.counter, params.count);
            trace_closest(device, scene.bvh, w.traversal, {w.rays, w.active, w.hits, rays});
            dispatch(device, look(params), rays);
            if (surface + 1 < surfaces) {
                compact(device, w.alive, w.active, w.next_active, {w.counters, next_counter}, rays);
                std::swap(w.active, w.next_active);
                std::swap(params.counter, next_counter);
            }
        }
    }
}

/// The same, once more and with care if a ray ran out of iterations: what a cover was found for
/// stays dropped.
template <class Params, class WriteRays, class Look>
void find_covers(Device& device, const DeviceScene& scene, PhotonWorkspace& w, std::uint64_t count,
                 const Params& params, const WriteRays& write_rays, const Look& look) {
    trace_to_places(device, scene, w, count, params, write_rays, look);
    if (!w.traversal.careful && download_word(device, w.traversal.unfinished) > 0) {
        w.traversal.careful = true;
        trace_to_places(device, scene, w, count, params, write_rays, look);
        w.traversal.careful = false;
    }
}

} // namespace

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
    find_covers(device, scene, w, 2 * std::uint64_t(samples),
                AreaCoverParams{.height = static_cast<float>(height)}, write_rays, look);
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
    find_covers(device, scene, w, slots,
                PhotonCoverParams{.height = static_cast<float>(height),
                                  .corrected_x = center.x,
                                  .corrected_y = center.y,
                                  .corrected_z = center.z,
                                  .corrected_distance = static_cast<float>(corrected.reach)},
                write_rays, look);
}

} // namespace argand
