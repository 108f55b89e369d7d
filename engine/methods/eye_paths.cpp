#include "methods/eye_paths.hpp"

#include "kernels/camera_rays.hpp"
#include "kernels/eye_vertex.hpp"
#include "kernels/film_add.hpp"
#include "kernels/query_ends.hpp"
#include "kernels/shadow_add.hpp"
#include "methods/lens.hpp"
#include "parallel/compact.hpp"
#include "photon/view_points.hpp"
#include "shared/alpha.h"
#include "shared/geometry_records.h"
#include "shared/light_path_records.h"
#include "shared/photon.h"
#include "shared/random.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace argand {

namespace {

// Paths traced together: enough to fill a device, few enough that a dispatch ends before a
// desktop's watchdog does.
constexpr std::uint64_t slots_on_cpu = 1u << 17;
constexpr std::uint64_t slots_on_gpu = 1u << 20;
// Queries of the photon map cost more than everything else. Where paths share no estimates, only
// every other sample has queries.
constexpr std::uint32_t samples_per_query = 2;
// Samples of a pixel that are traced together so that they share estimates.
constexpr std::uint64_t samples_that_share = 8;
// The film adds a pixel's samples in one loop: well below 65,535 iterations, at which lavapipe ends
// loops silently.
constexpr std::uint64_t most_samples_at_once = 1u << 14;
// Vertices recorded before the host looks whether any path is left.
constexpr int vertices_between_checks = 4;

std::uint64_t pixels_of_image(const RenderSettings& settings) {
    return static_cast<std::uint64_t>(settings.width) * static_cast<std::uint64_t>(settings.height);
}

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

void add_direct_light(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                      const Count& active) {
    {
        const StageScope stage(device, "trace shadow rays");
        trace_any(device, scene.bvh, w.traversal, {w.shadow_rays, w.active, w.occluded, active});
    }
    const StageScope stage(device, "shade");
    dispatch_indirect(
        device,
        kernels::shadow_add{.active_slots = w.active,
                            .counts = w.counts,
                            .occluded = w.occluded,
                            .shadows = w.shadows,
                            .layers = w.layers,
                            .constants = {.has_alpha = scene.plan.needs(Feature::alpha)}},
        w.counts);
}

/// Makes the paths that continue the active ones.
void advance(Device& device, EyeWorkspace& w, const Count& active) {
    const StageScope stage(device, "compact");
    compact(device, w.alive, w.active, w.next_active, {w.counts, 1}, active);
    device.copy(BufferView(w.counts, 4, 4), BufferView(w.counts, 0, 4));
    std::swap(w.active, w.next_active);
}

/// Adds the lights that the last shadow rays found to a list. alpha: they may bring a share of the
/// light.
void collect_found(Device& device, const EyeWorkspace& w, bool alpha,
                   std::vector<FoundLight>& found) {
    const std::uint32_t count = download_word(device, w.counts);
    const auto shadows = download<ShadowRecord>(device, w.shadows, w.slots);
    const auto rays = download<RayRecord>(device, w.shadow_rays, w.slots);
    const auto occluded = download<std::uint32_t>(device, w.occluded, w.slots);
    for (const std::uint32_t slot : download<std::uint32_t>(device, w.active, count)) {
        const RayRecord& ray = rays[slot];
        const float passed = alpha                 ? transmittance(occluded[slot])
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
                         .pixel = slot, // paths are numbered pixel by pixel
                         .indirect = (s.layers & 3u) == layer_indirect,
                         .radiance = radiance,
                         .point = {ray.origin_x, ray.origin_y, ray.origin_z},
                         .direction = {-ray.direction_x, -ray.direction_y, -ray.direction_z}});
    }
}

/// Traces the active paths until each has ended or waits for the answer of a query. Adds the
/// lights that shadow rays find to `found`.
void trace_until_queries(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                         const EyeBatch& batch, bool photon_map, std::vector<FoundLight>* found) {
    const Count active(w.counts, 0, std::uint64_t(batch.pixels) * batch.samples);
    for (int vertex = 1;; ++vertex) {
        {
            const StageScope stage(device, "trace eye rays");
            trace_closest(device, scene.bvh, w.traversal, {w.rays, w.active, w.hits, active});
        }
        shade(device, scene, w, batch, photon_map);
        if (scene.plan.needs(Feature::direct_light)) {
            add_direct_light(device, scene, w, active);
            if (found != nullptr) {
                collect_found(device, w, scene.plan.needs(Feature::alpha), *found);
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

/// Traces the paths of a batch to their end. All paths that wait at some vertex have their queries
/// answered together: few dispatches of many queries keep a GPU busy, and more of them share an
/// answer.
void trace_paths(Device& device, const DeviceScene& scene, EyeWorkspace& w, const Buffer& camera,
                 const EyeBatch& batch, const PhotonLookup* lookup,
                 std::vector<FoundLight>* found = nullptr) {
    const std::uint64_t slots = std::uint64_t(batch.pixels) * batch.samples;
    device.fill(w.traversal.unfinished, 0);
    start_paths(device, w, camera, batch);
    if (lookup == nullptr) {
        trace_until_queries(device, scene, w, batch, false, found);
        return;
    }
    device.fill(w.queries.kinds, 0);
    for (bool first = true;; first = false) {
        trace_until_queries(device, scene, w, batch, true, found);
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

/// Traces one batch. The film stays as it was if a ray or query ran out of iterations: the caller
/// then repeats the batch with `careful` set.
void trace_batch(Device& device, const DeviceScene& scene, EyeWorkspace& w, const EyeBatch& batch,
                 const PhotonLookup* lookup) {
    trace_paths(device, scene, w, w.camera, batch, lookup);
    const StageScope stage(device, "film");
    dispatch(device,
             kernels::film_add{.layers = w.layers,
                               .unfinished = w.traversal.unfinished,
                               .film = w.film.parts[batch.first_pixel / w.film.pixels_per_part],
                               .batch = batch},
             batch.pixels);
}

/// How a pass is divided into batches.
struct Batching {
    std::uint64_t samples, pixels; ///< of a batch, at most
};

Batching batching(const EyeWorkspace& w, const EyePass& pass, bool photon_map) {
    Batching b{};
    b.samples = samples_together(w, std::max(pass.samples, pass.samples_of_all), photon_map);
    b.pixels = std::min(w.film.pixels(), w.slots / b.samples);
    return b;
}

/// The batch that begins at a sample of the pass and at a pixel. It ends with its part of the film.
EyeBatch make_batch(const EyeWorkspace& w, const EyePass& pass, const Batching& most,
                    std::uint64_t sample, std::uint64_t pixel, std::uint32_t untaken) {
    const std::uint64_t film_end = (pixel / w.film.pixels_per_part + 1) * w.film.pixels_per_part;
    EyeBatch batch{};
    batch.seed = pass.seed;
    batch.first_pixel = static_cast<std::uint32_t>(pixel);
    batch.pixels = static_cast<std::uint32_t>(
        std::min({most.pixels, w.film.pixels() - pixel, film_end - pixel}));
    batch.first_film_pixel = static_cast<std::uint32_t>(film_end - w.film.pixels_per_part);
    batch.first_sample = pass.first_sample + static_cast<std::uint32_t>(sample);
    batch.samples =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(most.samples, pass.samples - sample));
    batch.width = w.image_width;
    batch.height = w.image_height;
    batch.crop_x = static_cast<std::uint32_t>(w.crop.x0);
    batch.crop_y = static_cast<std::uint32_t>(w.crop.y0);
    batch.crop_width = static_cast<std::uint32_t>(w.crop.width());
    batch.bounces = pass.bounces;
    batch.light_paths = static_cast<float>(pass.light_paths);
    batch.shares_queries = w.queries.sharing.cell > 0 ? 1 : 0;
    batch.untaken = untaken;
    // The noise of a final gather is that of the scattered directions, so all samples have queries.
    // A path that goes on has no query_weight, so its sample must have a query of its own.
    batch.query_step = w.queries.final_gather || untaken != untaken_never ? 1 : samples_per_query;
    const std::uint32_t querying = (batch.samples + batch.query_step - 1) / batch.query_step;
    batch.query_weight = static_cast<float>(batch.samples) / static_cast<float>(querying);
    return batch;
}

/// The slots of the queries that an estimator answers.
std::vector<std::uint32_t> answered_slots(Device& device, const PhotonQueries& queries) {
    const std::uint32_t count = download_word(device, queries.count.buffer, queries.count.index);
    return download<std::uint32_t>(device, queries.slots, count);
}

/// Collects query points instead of estimating radiance at them: all estimates are 0.
class QueryCollector final : public PhotonEstimator {
public:
    QueryCollector(Device& device, std::size_t slots) : device_(device), slots_(slots) {}

    void estimate(const PhotonMap&, const PhotonQueries& queries) override {
        device_.fill(queries.estimates, 0); // paths go on or end as their answers tell
        const auto records = download<QueryRecord>(device_, queries.points, slots_);
        for (const std::uint32_t slot : answered_slots(device_, queries)) {
            const QueryRecord& record = records[slot];
            if ((record.flags & query_caustics) == 0) {
                const std::uint32_t normal =
                    pack_photon_normal(unpack_unit(record.geometric_normal), false);
                points.push_back({record.x, record.y, record.z, normal, {}});
            }
        }
    }

    std::vector<ViewPointRecord> points;

private:
    Device& device_;
    std::size_t slots_;
};

/// Counts answers, and those that are not to be taken.
class AnswerProbe final : public PhotonEstimator {
public:
    AnswerProbe(Device& device, std::size_t slots, double least_coverage,
                PhotonEstimator& estimator)
        : device_(device), slots_(slots), least_coverage_(least_coverage), estimator_(estimator) {}

    void estimate(const PhotonMap& map, const PhotonQueries& queries) override {
        estimator_.estimate(map, queries);
        if (queries.part == map_caustic) {
            return;
        }
        const auto records = download<QueryRecord>(device_, queries.points, slots_);
        const auto estimates = download<EstimateRecord>(device_, queries.estimates, slots_);
        for (const std::uint32_t slot : answered_slots(device_, queries)) {
            if ((records[slot].flags & query_caustics) == 0) {
                const EstimateRecord& e = estimates[slot];
                const bool lacks = e.coverage < least_coverage_;
                ++answers;
                strongly += lacks || e.uneven > Untaken::strongly_uneven ? 1 : 0;
                mildly += lacks || e.uneven > Untaken::mildly_uneven ? 1 : 0;
            }
        }
    }

    /// Answers, and those that lack the least coverage or are uneven.
    std::uint64_t answers = 0, strongly = 0, mildly = 0;

private:
    Device& device_;
    std::size_t slots_;
    double least_coverage_;
    PhotonEstimator& estimator_;
};

/// One sample for each pixel of a small version of the image, with as many pixels as there are
/// slots: a part of a larger one would be its top only.
EyeBatch batch_of_small_image(const EyeWorkspace& w, const RenderSettings& settings,
                              int longer_side) {
    const int longer = std::max(settings.width, settings.height);
    EyeBatch batch{};
    batch.seed = settings.seed;
    const auto pixels_along = [&](int side) {
        const std::int64_t pixels = std::int64_t(side) * longer_side / longer;
        return static_cast<std::uint32_t>(std::max<std::int64_t>(pixels, 1));
    };
    do {
        batch.width = pixels_along(settings.width);
        batch.height = pixels_along(settings.height);
        batch.pixels = batch.width * batch.height;
    } while (batch.pixels > w.slots && --longer_side > 0);
    batch.crop_width = batch.width; // all of it
    batch.samples = 1;
    batch.bounces = settings.bounces;
    batch.query_step = 1;
    batch.query_weight = 1;
    return batch;
}

/// The camera of a small version of the image, with the image's lens.
Buffer camera_of(Device& device, const EyeBatch& batch, const Camera& camera,
                 const CameraRecord& of_image) {
    CameraRecord record =
        camera_record(camera, static_cast<int>(batch.width), static_cast<int>(batch.height));
    copy_lens(of_image, record);
    return upload<CameraRecord>(device, "camera", std::span(&record, 1));
}

std::vector<ViewPointRecord> collect_queries(Device& device, const DeviceScene& scene,
                                             EyeWorkspace& w, const RenderSettings& settings,
                                             const Camera& camera, int longer_side) {
    const EyeBatch batch = batch_of_small_image(w, settings, longer_side);
    const Buffer small_image = camera_of(device, batch, camera, w.queries.view);
    const QuerySharing sharing = std::exchange(w.queries.sharing, {});
    QueryCollector collector(device, batch.pixels);
    const PhotonMap no_map;
    const PhotonLookup lookup{.map = no_map, .estimator = collector};
    trace_paths(device, scene, w, small_image, batch, &lookup);
    w.queries.sharing = sharing;
    return std::move(collector.points);
}

} // namespace

EyeWorkspace make_eye_workspace(Device& device, const Plan& plan, const RenderSettings& settings,
                                const CameraRecord& camera) {
    EyeWorkspace w;
    w.lattice = settings.deterministic;
    w.cones = plan.needs(Feature::mip_maps);
    w.image_width = static_cast<std::uint32_t>(settings.width);
    w.image_height = static_cast<std::uint32_t>(settings.height);
    w.crop = settings.crop.value_or(CropRectangle{0, 0, settings.width, settings.height});
    w.cropped = settings.crop.has_value() || settings.everything;
    w.filtered = settings.filter != PixelFilter::box;
    w.film = make_film(device, w.crop.width(), w.crop.height());
    // As many as the whole image has: what is learnt from the slots does not depend on the crop.
    w.slots = std::min(device.info().lane_serial() ? slots_on_cpu : slots_on_gpu,
                       pixels_of_image(settings) * settings.samples);
    w.slots = std::min(w.slots, device.info().limits.storage_range /
                                    sizeof(GatherRecord)); // the largest per slot
    const auto per_slot = [&](const char* name, std::uint64_t bytes) {
        return device.allocate(name, w.slots * bytes);
    };
    // A kernel takes at least an element of each of its buffers.
    const auto per_slot_if = [&](bool needed, const char* name, std::uint64_t bytes) {
        return device.allocate(name, (needed ? w.slots : 1) * bytes);
    };
    const bool direct = plan.needs(Feature::direct_light);
    w.camera = upload<CameraRecord>(device, "camera", std::span(&camera, 1));
    w.rays = per_slot("eye rays", sizeof(RayRecord));
    w.hits = per_slot("eye hits", sizeof(HitRecord));
    w.paths = per_slot("eye paths", sizeof(PathRecord));
    w.layers = per_slot("eye path layers", sizeof(LayersRecord));
    w.active = per_slot("active eye paths", 4);
    w.next_active = per_slot("active eye paths", 4);
    w.alive = per_slot("eye path flags", 4);
    w.shadow_rays = per_slot_if(direct, "shadow rays", sizeof(RayRecord));
    w.shadows = per_slot_if(direct, "shadow contributions", sizeof(ShadowRecord));
    w.occluded = per_slot_if(direct, "shadow ray flags", 4);
    w.counts = device.allocate("eye path counts", 16);
    w.weights = per_slot_if(plan.needs(Feature::light_paths), "weights of eye paths",
                            sizeof(EyeWeightRecord));
    w.queries = make_eye_queries(device, plan, w.slots, camera);
    w.queries.least_coverage = settings.least_coverage;
    w.traversal = make_traversal(device, w.slots);
    return w;
}

void set_camera(Device& device, EyeWorkspace& w, const CameraRecord& camera) {
    device.upload(w.camera, 0, std::as_bytes(std::span(&camera, 1)));
    w.queries.view = camera;
}

void restart(Device& device, EyeWorkspace& w) {
    w.queries.sharing = {};
    w.traversal.careful = false; // the next image may be easier
    for (const Buffer& part : w.film.parts) {
        device.fill(part, 0);
    }
}

std::uint32_t samples_together(const EyeWorkspace& w, std::uint32_t samples, bool photon_map) {
    const std::uint64_t least = photon_map ? std::min(samples_that_share, w.slots) : 1;
    return static_cast<std::uint32_t>(std::min({std::max(w.slots / w.film.pixels(), least),
                                                std::uint64_t(samples), most_samples_at_once}));
}

bool trace_eye_paths(Device& device, const DeviceScene& scene, EyeWorkspace& w, const EyePass& pass,
                     const PhotonLookup* lookup, const OnProgress& progress) {
    const Batching most = batching(w, pass, lookup != nullptr);
    const double work = static_cast<double>(w.film.pixels()) * pass.samples;
    double done = 0;
    bool interrupted = false;
    for (std::uint64_t sample = 0; sample < pass.samples; sample += most.samples) {
        for (std::uint64_t pixel = 0; pixel < w.film.pixels();) {
            const EyeBatch batch =
                make_batch(w, pass, most, sample, pixel,
                           lookup != nullptr ? lookup->untaken.often : untaken_never);
            pixel += batch.pixels;
            trace_batch(device, scene, w, batch, lookup);
            if (!w.traversal.careful && download_word(device, w.traversal.unfinished) > 0) {
                w.traversal.careful = true;
                trace_batch(device, scene, w, batch, lookup);
            }
            done += static_cast<double>(batch.pixels) * batch.samples;
            // Goes on to the last pixel, so that all pixels hold the same samples.
            interrupted = !progress(done / work) || interrupted;
        }
        if (interrupted) {
            return false;
        }
    }
    return true;
}

std::vector<glm::vec4> sample_queries(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                                      const RenderSettings& settings, const Camera& camera) {
    std::vector<glm::vec4> points;
    for (const ViewPointRecord& p : collect_queries(device, scene, w, settings, camera, 48)) {
        points.emplace_back(p.x, p.y, p.z, 0);
    }
    return points;
}

ViewPoints sample_view_points(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                              const RenderSettings& settings, const Camera& camera, double radius) {
    return make_view_points(device, collect_queries(device, scene, w, settings, camera, 96),
                            radius);
}

Untaken learn_untaken(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                      const RenderSettings& settings, const Camera& camera,
                      const PhotonLookup& lookup) {
    constexpr double small_share = 0.005, large_share = 0.02;
    if (!(settings.least_coverage > 0) || !scene.plan.needs(Feature::direct_light)) {
        return {};
    }
    EyeBatch batch = batch_of_small_image(w, settings, 48);
    // Other paths than the image's own, whose estimates it decides about.
    batch.seed = pcg4d({settings.seed, 0x07a4eu, 0, 0}).x;
    const Buffer small_image = camera_of(device, batch, camera, w.queries.view);
    const double cell = std::exchange(w.queries.sharing.cell, 0.0);
    const bool careful = std::exchange(w.traversal.careful, true);
    AnswerProbe probe(device, batch.pixels, settings.least_coverage,
                      w.queries.final_gather ? lookup.gathering_estimator() : lookup.estimator);
    const PhotonLookup probed{.map = lookup.map, .estimator = probe};
    trace_paths(device, scene, w, small_image, batch, &probed);
    w.queries.sharing.cell = cell;
    w.traversal.careful = careful;
    const auto answers = static_cast<double>(probe.answers);
    if (static_cast<double>(probe.mildly) > large_share * answers) {
        return {untaken_often, Untaken::mildly_uneven};
    }
    const bool often = static_cast<double>(probe.strongly) > small_share * answers;
    return {often ? untaken_often : untaken_seldom, Untaken::strongly_uneven};
}

std::vector<FoundLight> sample_lights(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                                      const RenderSettings& settings, const Camera& camera,
                                      std::uint32_t round) {
    constexpr std::uint64_t least_paths = 1024, most_paths = 16384;
    const std::vector<LightRecord>& lights = scene.light_table.lights;
    // Where photons start and in which directions is more to learn than how to choose lights.
    const bool aims =
        scene.plan.needs_photons() && std::any_of(lights.begin(), lights.end(), is_from_outside);
    const std::uint64_t share_of_image = aims ? 4 : 16;
    EyeBatch batch = batch_of_small_image(w, settings, 32);
    // These paths must not be the image's own: a choice that depends on them would bias it.
    batch.seed = pcg4d({settings.seed, 0x11947u, round, 0}).x;
    const std::uint64_t paths = std::clamp(
        pixels_of_image(settings) * settings.samples / share_of_image, least_paths, most_paths);
    batch.samples = static_cast<std::uint32_t>(
        std::max<std::uint64_t>(std::min(paths, w.slots) / batch.pixels, 1));
    const Buffer small_image = camera_of(device, batch, camera, w.queries.view);
    std::vector<FoundLight> found;
    trace_paths(device, scene, w, small_image, batch, nullptr, &found);
    for (FoundLight& f : found) {
        f.pixel /= batch.samples;
    }
    return found;
}

} // namespace argand
