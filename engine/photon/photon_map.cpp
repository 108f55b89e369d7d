#include "photon/photon_map.hpp"

#include "device/copy_elements.hpp"
#include "kernels/area_footprints.hpp"
#include "kernels/area_samples.hpp"
#include "kernels/flux_sum.hpp"
#include "kernels/photon_advance.hpp"
#include "kernels/photon_boxes.hpp"
#include "kernels/photon_emit.hpp"
#include "kernels/photon_footprints.hpp"
#include "kernels/photon_leaves.hpp"
#include "kernels/photon_order.hpp"
#include "kernels/photon_scatter.hpp"
#include "kernels/photon_tally.hpp"
#include "parallel/compact.hpp"
#include "parallel/reduce.hpp"
#include "photon/covered.hpp"
#include "photon/covered_caustics.hpp"
#include "photon/sort_photons.hpp"
#include "shared/differential_record.h"
#include "shared/footprint.h"
#include "shared/geometry_records.h"
#include "shared/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace argand {

namespace {

constexpr std::uint64_t slots_on_cpu = 1u << 18;
constexpr std::uint64_t slots_on_gpu = 1u << 20;
// Initial room for stored photons, per emitted photon.
constexpr std::uint64_t stored_per_emitted = 3;
// PhotonBatch::least_scatterings if no photon is stored.
constexpr std::uint32_t unstored = 0xffffffff;
constexpr int bounces_between_checks = 4;
constexpr std::uint32_t ledgers_per_thread = 64;
// T_auto of Fabianowski and Dingliana 2009 (§5.3), who have it grow with the number of footprints
// on a point. With the bandwidths used here 16 is best, or within 3 % of it, for 2 to 350
// footprints on a point: docs/results/fd09.md.
constexpr std::uint32_t automatic_leaf_size = 16;

void allocate_stored(Device& device, PhotonWorkspace& w, std::uint64_t capacity) {
    w.capacity = capacity;
    w.photons = device.allocate("photons", capacity * sizeof(PhotonRecord));
    w.offsets = device.allocate("photon differentials, stored", w.extents != extents_none
                                                                    ? capacity * sizeof(glm::uvec4)
                                                                    : sizeof(glm::uvec4));
    w.lights = device.allocate("photons' lights", (w.keeps_lights ? capacity : 1) * 4);
    w.vertices =
        device.allocate("vertices of photons' paths",
                        (w.keeps_paths ? 2 * w.most_paths + capacity : 1) * sizeof(PathVertex));
    w.codes = device.allocate("photon codes", capacity * 4);
    w.order = device.allocate("photon order", capacity * 4);
    w.heads = device.allocate("photon map heads", capacity * 4);
}

/// Grows the buffers to `wanted` records, at most the device's storage range, and keeps the first
/// `stored`.
void make_room(Device& device, PhotonWorkspace& w, std::uint64_t stored, std::uint64_t wanted) {
    const std::uint64_t capacity = std::min(wanted, max_stored_photons(device));
    if (capacity <= w.capacity) {
        return;
    }
    const Buffer photons = w.photons;
    const Buffer offsets = w.offsets;
    const Buffer lights = w.lights;
    const Buffer vertices = w.vertices;
    allocate_stored(device, w, capacity);
    copy_elements(device, photons, 0, w.photons, 0, stored, sizeof(PhotonRecord));
    copy_elements(device, offsets, 0, w.offsets, 0, w.extents != extents_none ? stored : 0,
                  sizeof(glm::uvec4));
    copy_elements(device, lights, 0, w.lights, 0, w.keeps_lights ? stored : 0, 4);
    copy_elements(device, vertices, 0, w.vertices, 0, w.keeps_paths ? 2 * w.most_paths + stored : 0,
                  sizeof(PathVertex));
}

std::uint32_t kept_of(const PhotonWorkspace& w) {
    return (w.keeps_lights ? kept_light : 0) | (w.keeps_paths ? kept_path : 0) |
           (w.tracer ? kept_start : 0);
}

/// Emits the photons of a batch.
void emit_photons(Device& device, const DeviceScene& scene, PhotonWorkspace& w,
                  const PhotonBatch& batch) {
    const StageScope stage(device, "emit photons");
    dispatch(device,
             kernels::photon_emit{.scene = scene.bindings(),
                                  .texture = scene.texture_bindings(),
                                  .rays = w.rays,
                                  .paths = w.paths,
                                  .ledgers = w.ledgers,
                                  .active_slots = w.active,
                                  .differentials = w.differentials,
                                  .aim_nodes = scene.aim_nodes,
                                  .sky = scene.sky,
                                  .path_lights = w.path_lights,
                                  .path_vertices = w.path_vertices,
                                  .vertices = w.vertices,
                                  .hits = w.hits,
                                  .batch = batch,
                                  .constants = {.footprints = w.extents == extents_differentials,
                                                .numbers = w.numbers,
                                                .keeps = kept_of(w),
                                                .scene = scene.constants(),
                                                .texture = scene.texture_constants()}},
             batch.count);
    upload_word(device, w.counters, counter_active, batch.count);
}

/// Lets the active photons of a batch scatter, and makes those active that go on.
void scatter_photons(Device& device, const DeviceScene& scene, PhotonWorkspace& w,
                     const PhotonBatch& batch, const Count& active) {
    const StageScope stage(device, "scatter photons");
    dispatch(device,
             kernels::photon_scatter{
                 .scene = scene.bindings(),
                 .texture = scene.texture_bindings(),
                 .hits = w.hits,
                 .active_slots = w.active,
                 .counters = w.counters,
                 .rays = w.rays,
                 .paths = w.paths,
                 .ledgers = w.ledgers,
                 .photons = w.photons,
                 .alive = w.alive,
                 .differentials = w.differentials,
                 .offsets = w.offsets,
                 .path_lights = w.path_lights,
                 .photon_lights = w.lights,
                 .path_vertices = w.path_vertices,
                 .vertices = w.vertices,
                 .batch = batch,
                 .constants = {.extents = w.extents,
                               .reemission = w.reemission,
                               .numbers = w.numbers,
                               .followed_paths = scene.plan.needs(Feature::followed_paths),
                               .aims_at_view = scene.record.view_share > 0,
                               .keeps = kept_of(w),
                               .scene = scene.constants(),
                               .material_features = scene.plan.material_features(),
                               .texture = scene.texture_constants()}},
             active);
    compact(device, w.alive, w.active, w.next_active, {w.counters, counter_next_active}, active);
    std::swap(w.active, w.next_active);
    dispatch(
        device,
        kernels::photon_advance{.counters = w.counters,
                                .params = {.stored = batch.has_slots, .capacity = batch.capacity}},
        1);
}

/// Traces the photons of one batch to their end. Returns false if a ray ran out of iterations.
bool trace_batch(Device& device, const DeviceScene& scene, PhotonWorkspace& w, PhotonBatch batch,
                 const OnPhotonHits& on_hits) {
    const Plan& plan = scene.plan;
    // Photons that pass surfaces scatter in a later round than others.
    const bool any_round = plan.needs(Feature::alpha);
    device.fill(w.traversal.unfinished, 0);
    emit_photons(device, scene, w, batch);
    for (std::uint32_t bounce = 0;; ++bounce) {
        const bool last = bounce >= batch.bounces;
        batch.has_slots =
            w.stores && bounce >= batch.least_scatterings && (any_round || bounce <= batch.bounces)
                ? 1
                : 0;
        const Count active(w.counters, counter_active, batch.count);
        {
            const StageScope stage(device, "trace photons");
            const RayBatch rays{w.rays, w.active, w.hits, active};
            if (w.tracer) {
                w.tracer(rays);
            } else {
                trace_closest(device, scene.bvh, w.traversal, rays);
            }
        }
        if (on_hits) {
            on_hits(batch, active);
        }
        scatter_photons(device, scene, w, batch, active);
        device.submit();
        const bool looks = last || bounce % bounces_between_checks == bounces_between_checks - 1;
        if ((last && !any_round) ||
            (looks && download_word(device, w.counters, counter_active) == 0)) {
            break;
        }
    }
    return download_word(device, w.traversal.unfinished) == 0 || w.traversal.careful;
}

/// Appends samples of the surfaces' area to the photons. Returns their number, 0 if there is too
/// little room.
std::uint32_t add_area_samples(Device& device, const DeviceScene& scene, PhotonWorkspace& w,
                               const StoredPhotons& stored, const PhotonMapSettings& settings) {
    // Drops the samples of a map that was built before.
    upload_word(device, w.counters, counter_stored_slots, static_cast<std::uint32_t>(stored.slots));
    // A ninth of the samples wanted is enough. A single one cannot be: the step between two samples
    // has 32 bits.
    const std::uint64_t fitting = std::min(settings.area_samples, w.capacity - stored.slots);
    if (fitting <= 1 || 9 * fitting < settings.area_samples || !(scene.areas.area > 0) ||
        stored.photons == 0) {
        return 0;
    }
    const auto samples = static_cast<std::uint32_t>(fitting);
    const StageScope stage(device, "sample areas");
    const auto step = static_cast<std::uint32_t>((1ull << 32) / samples);
    // A random start, so that the number of samples on a triangle is right on average.
    const std::uint64_t random = pcg4d({settings.seed, samples, 0x0ff5e7u, 0}).x;
    dispatch(device,
             kernels::area_samples{
                 .scene = scene.bindings(),
                 .texture = scene.texture_bindings(),
                 .area_sums = scene.areas.sums,
                 .counters = w.counters,
                 .photons = w.photons,
                 .params = {.seed = settings.seed,
                            .count = samples,
                            .step = step,
                            .area = static_cast<float>(scene.areas.area * step / 4294967296.0),
                            .piece_count = scene.areas.pieces,
                            .capacity = static_cast<std::uint32_t>(w.capacity),
                            .offset = static_cast<std::uint32_t>(random * step >> 32)},
                 .constants = {.has_alpha = scene.plan.needs(Feature::alpha),
                               .texture = scene.texture_constants()}},
             samples);
    if (settings.cover_height > 0) {
        drop_covered_areas(device, scene, w, samples, settings.cover_height);
    }
    if (settings.drops_covered && settings.view != nullptr) {
        drop_unlinked_areas(device, scene, w, samples, *settings.view,
                            corrected_part(scene.areas.part));
    }
    upload_word(device, w.counters, counter_stored_slots,
                static_cast<std::uint32_t>(stored.slots + samples));
    return samples;
}

/// Builds the tree over the sorted records. Waits for the device.
void build_tree(Device& device, PhotonWorkspace& w, bool wide_codes, PhotonMap& map) {
    const Count photons(w.counters, counter_stored, w.capacity);
    const Buffer distances = code_distances(device, w.codes, photons, wide_codes);
    // The order of the sort is not needed any more; its memory takes the leaves.
    dispatch(device,
             kernels::photon_leaves{.distances = distances,
                                    .counters = w.counters,
                                    .leaves = w.order,
                                    .heads = w.heads,
                                    .params = {.leaf_size = map.leaf_size}},
             photons);
    const Buffer compacted = device.scratch("photon map leaves", w.capacity * 4);
    compact(device, w.heads, w.order, compacted, {w.counters, counter_leaves}, photons);
    const std::uint64_t leaf_count = download_word(device, w.counters, counter_leaves);
    const std::uint64_t allocated = std::max<std::uint64_t>(leaf_count, 1);
    const Buffer boxes = device.scratch("photon map boxes", allocated * sizeof(BoxRecord));
    const Buffer leaf_distances = device.scratch("photon map leaf distances", allocated * 4);
    dispatch(device,
             kernels::photon_boxes{
                 .photons = map.photons,
                 .distances = distances,
                 .leaves = compacted,
                 .counters = w.counters,
                 .boxes = boxes,
                 .leaf_distances = leaf_distances,
                 .footprints = map.footprints ? map.footprints : map.photons,
                 .params = {.flatness = map.flatness},
                 .constants = {.around_footprints = static_cast<bool>(map.footprints)}},
             leaf_count);
    const Buffer leaves = device.allocate("photon map leaves", allocated * 4);
    copy_elements(device, compacted, 0, leaves, 0, allocated, 4);
    map.lbvh = build_lbvh_in_order(device, boxes, leaf_distances, leaves, Count(leaf_count));
}

/// Whether discs or footprints of caustics hold enough area samples for their correction.
bool holds_areas_in_caustics(Device& device, const DeviceScene& scene, const PhotonWorkspace& w,
                             const PhotonMapSettings& settings, const PhotonMap& map) {
    if (map.area_samples == 0 || !scene.plan.needs(Feature::caustics)) {
        return false;
    }
    if (settings.footprints) {
        return download_word(device, w.counters, counter_wide_caustics) > 0;
    }
    const double disc = std::numbers::pi * settings.caustic_radius * settings.caustic_radius;
    return samples_per_area(scene, map.area_samples) * disc > least_cover_samples;
}

} // namespace

std::uint32_t extents_of(const Plan& plan) {
    return plan.needs(Feature::differentials) ? extents_differentials : extents_none;
}

std::uint64_t max_stored_photons(const Device& device) {
    return std::min<std::uint64_t>(device.info().limits.storage_range / sizeof(PhotonRecord),
                                   most_photons_in_map);
}

std::uint64_t max_photons_per_pass(const Device& device) {
    return max_stored_photons(device) / stored_per_emitted;
}

PhotonWorkspace make_photon_workspace(Device& device, std::uint64_t photons_per_pass,
                                      const KeptOfPhotons& kept) {
    PhotonWorkspace w;
    w.extents = kept.extents;
    w.stores = kept.stores;
    w.keeps_lights = kept.lights;
    w.keeps_paths = kept.paths;
    w.most_paths = photons_per_pass;
    w.slots = std::min(device.info().lane_serial() ? slots_on_cpu : slots_on_gpu,
                       std::max<std::uint64_t>(photons_per_pass, 1));
    w.slots = std::min(w.slots, device.info().limits.storage_range / sizeof(FluxLedger));
    const auto per_slot = [&](const char* name, std::uint64_t bytes) {
        return device.allocate(name, w.slots * bytes);
    };
    w.rays = per_slot("photon rays", sizeof(RayRecord));
    w.hits = per_slot("photon hits", sizeof(HitRecord));
    w.paths = per_slot("photon paths", sizeof(PhotonPathRecord));
    w.ledgers = per_slot("photon ledgers", sizeof(FluxLedger));
    w.active = per_slot("active photons", 4);
    w.next_active = per_slot("active photons", 4);
    w.alive = per_slot("photon flags", 4);
    w.differentials =
        device.allocate("photon differentials", (w.extents == extents_differentials ? w.slots : 1) *
                                                    sizeof(DifferentialRecord));
    w.path_lights = device.allocate("photon paths' lights", (w.keeps_lights ? w.slots : 1) * 4);
    w.path_vertices = device.allocate("photon paths' vertices", (w.keeps_paths ? w.slots : 1) * 4);
    w.counters = device.allocate("photon counters", counter_count * 4);
    w.flux_sums = device.allocate("flux sums", flux_words * sizeof(std::int64_t));
    device.fill(w.flux_sums, 0);
    w.traversal = make_traversal(device, w.slots);
    allocate_stored(
        device, w,
        std::max<std::uint64_t>(w.stores ? photons_per_pass * stored_per_emitted : 0, 8));
    return w;
}

std::optional<StoredPhotons> trace_photons(Device& device, const DeviceScene& scene,
                                           PhotonWorkspace& w, const PhotonPass& pass,
                                           float flux_unit, const OnPhotonHits& on_hits) {
    device.fill(w.counters, 0);
    for (std::uint64_t first = 0; first < pass.count; first += w.slots) {
        PhotonBatch batch{};
        batch.seed = pass.seed;
        batch.first = static_cast<std::uint32_t>(pass.first + first);
        batch.count = static_cast<std::uint32_t>(std::min(w.slots, pass.count - first));
        batch.first_path = static_cast<std::uint32_t>(first);
        batch.paths = static_cast<std::uint32_t>(pass.count);
        batch.inverse_total = static_cast<float>(1.0 / static_cast<double>(pass.count));
        batch.inverse_spread = pass.spread > 0
                                   ? static_cast<float>(1.0 / static_cast<double>(pass.spread))
                                   : batch.inverse_total;
        batch.bounces = pass.bounces;
        // Without slots no number of scatterings is enough.
        batch.least_scatterings = !w.stores ? unstored : pass.first_hits ? 0 : 1;
        batch.flux_unit = flux_unit;
        for (;;) {
            batch.capacity = static_cast<std::uint32_t>(w.capacity);
            const std::vector<std::uint32_t> before =
                download<std::uint32_t>(device, w.counters, counter_count);
            const bool traced = trace_batch(device, scene, w, batch, on_hits);
            const bool fits = download_word(device, w.counters, counter_overflow) == 0;
            if (traced && fits) {
                break;
            }
            // Traced again, with care or with more room: random numbers belong to photons, so they
            // take the same ways.
            w.traversal.careful = !traced;
            device.upload(w.counters, 0, std::as_bytes(std::span(before)));
            if (!fits) {
                if (w.capacity >= max_stored_photons(device)) {
                    return std::nullopt;
                }
                make_room(device, w, before[counter_stored_slots], 2 * w.capacity);
            }
        }
        const StageScope stage(device, "sum flux");
        dispatch(device,
                 kernels::flux_sum{
                     .ledgers = w.ledgers, .sums = w.flux_sums, .params = {.count = batch.count}},
                 (batch.count + ledgers_per_thread - 1) / ledgers_per_thread);
    }
    dispatch(device, kernels::photon_tally{.photons = w.photons, .counters = w.counters},
             (w.capacity + slots_per_tally - 1) / slots_per_tally);
    const std::vector<std::uint32_t> counters =
        download<std::uint32_t>(device, w.counters, counter_count);
    return StoredPhotons{.slots = counters[counter_stored_slots],
                         .photons = counters[counter_photons],
                         .emitted = pass.count,
                         .near = counters[counter_near]};
}

double samples_per_area(const DeviceScene& scene, std::uint32_t area_samples) {
    return area_samples / std::max(scene.areas.area, 1e-30);
}

FootprintParams footprint_params(const DeviceScene& scene, const FootprintScale& scale,
                                 std::uint32_t area_samples) {
    FootprintParams params{.scale = scale};
    params.inverse_surface_area = static_cast<float>(1 / std::max(scene.surface_area, 1e-30));
    constexpr double least_overlap = 4;
    params.samples_per_area = static_cast<float>(samples_per_area(scene, area_samples));
    params.least_area_radius = static_cast<float>(std::sqrt(
        least_overlap * scene.areas.area / (std::numbers::pi * std::max(area_samples, 1u))));
    return params;
}

void make_footprints(Device& device, const DeviceScene& scene, PhotonWorkspace& w,
                     const FootprintScale& scale, PhotonMap& map) {
    map.footprints =
        unshared(device, w.last_footprints, "photon footprints", w.capacity * sizeof(glm::uvec4));
    map.flatness = scale.flatness;
    const FootprintParams params = footprint_params(scene, scale, map.area_samples);
    upload_word(device, w.counters, counter_area_places, 0);
    upload_word(device, w.counters, counter_wide_caustics, 0);
    const Buffer area_places =
        device.scratch("area samples' places", std::max<std::uint64_t>(map.area_samples, 1) * 4);
    const Count stored(w.counters, counter_stored, w.capacity);
    // `heads` is free until the tree's leaves are marked.
    dispatch(device,
             kernels::photon_footprints{.photons = w.photons,
                                        .order = w.order,
                                        .counters = w.counters,
                                        .offsets = w.offsets,
                                        .footprints = map.footprints,
                                        .shares = w.heads,
                                        .area_places = area_places,
                                        .wide_caustics = wide_caustics(device, w),
                                        .params = params},
             stored);
    dispatch_indirect(device,
                      kernels::area_footprints{.photons = map.photons,
                                               .area_places = area_places,
                                               .counters = w.counters,
                                               .footprints = map.footprints,
                                               .params = params},
                      w.counters, counter_area_places);
    reduce_sum(device, w.heads, w.counters, counter_footprints, stored);
    map.mean_footprints =
        double(download_word(device, w.counters, counter_footprints)) / area_shares;
}

std::uint32_t append_area_samples(Device& device, const DeviceScene& scene, PhotonWorkspace& w,
                                  const StoredPhotons& stored, const PhotonMapSettings& settings) {
    make_room(device, w, stored.slots, stored.slots + settings.area_samples);
    return add_area_samples(device, scene, w, stored, settings);
}

PhotonMap build_photon_map(Device& device, const DeviceScene& scene, PhotonWorkspace& w,
                           const StoredPhotons& stored, const PhotonMapSettings& settings) {
    PhotonMap map;
    map.area_samples = append_area_samples(device, scene, w, stored, settings);
    map.photons =
        unshared(device, w.last_sorted, "photons, sorted", w.capacity * sizeof(PhotonRecord));
    map.corrected = corrected_part(scene.areas.part);
    if (map.area_samples > 0 && settings.drops_covered) {
        const StageScope stage(device, "sample areas");
        drop_covered_photons(device, scene, w, stored.slots, settings.cover_height, map.corrected);
        if (settings.view != nullptr) {
            drop_unlinked_photons(device, scene, w, stored.slots, *settings.view, map.corrected);
        }
    }
    map.frontier = settings.frontier;
    // Footprints of area samples are made from those of their neighbours in the order.
    if (map.frontier && !settings.footprints) {
        const StageScope stage(device, "build photon map");
        list_places(device, w);
    } else {
        const StageScope stage(device, "sort photons");
        sort_places(device, w, map.photons, settings.wide_codes);
    }
    const StageScope stage(device, "build photon map");
    dispatch_indirect(
        device,
        kernels::photon_order{
            .photons = w.photons, .order = w.order, .counters = w.counters, .sorted = map.photons},
        w.counters, counter_stored);
    if (settings.footprints) {
        make_footprints(device, scene, w, *settings.footprints, map);
    }
    if (!map.frontier) {
        map.leaf_size = settings.leaf_size > 0 ? settings.leaf_size : automatic_leaf_size;
        build_tree(device, w, settings.wide_codes, map);
    }
    // A tree over blocks of samples is of use only if they are in order.
    if ((!map.frontier || settings.footprints) &&
        holds_areas_in_caustics(device, scene, w, settings, map)) {
        map.areas = build_area_tree(device, map.photons, w.counters, map.area_samples);
        map.areas.samples_per_area = samples_per_area(scene, map.area_samples);
    }
    if (settings.footprints) {
        correct_caustic_footprints(device, w, map, settings.uniform_kernel);
    }
    map.counters = device.allocate("photon map counters", counter_count * 4);
    copy_elements(device, w.counters, 0, map.counters, 0, counter_count, 4);
    return map;
}

} // namespace argand
