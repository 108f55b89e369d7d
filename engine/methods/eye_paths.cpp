#include "methods/eye_paths.hpp"

#include "kernels/film_add.hpp"
#include "methods/eye_tracing.hpp"
#include "shared/geometry_records.h"
#include "shared/light_path_records.h"
#include "shared/photon.h"

#include <algorithm>

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
                                    std::max(sizeof(GatherRecord), sizeof(QueryBsdfRecord)));
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

} // namespace argand
