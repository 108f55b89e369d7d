#include "methods/eye_paths.hpp"

#include "kernels/camera_rays.hpp"
#include "kernels/estimate_add.hpp"
#include "kernels/eye_vertex.hpp"
#include "kernels/film_add.hpp"
#include "kernels/query_cells.hpp"
#include "kernels/query_owners.hpp"
#include "kernels/shadow_add.hpp"
#include "parallel/compact.hpp"
#include "shared/geometry_records.h"
#include "shared/photon_records.h"
#include "shared/query_record.h"

#include <algorithm>
#include <bit>

namespace argand {

namespace {

// Paths traced together: enough to fill a device, few enough that a dispatch stays below what a
// desktop's watchdog allows.
constexpr std::uint64_t slots_on_cpu = 1u << 17;
constexpr std::uint64_t slots_on_gpu = 1u << 20;
// Asking for light from photons costs more than all the rest. Where answers are not shared, every
// other sample asks.
constexpr std::uint32_t samples_per_query = 2;
// Samples of a pixel that are traced together for the sake of sharing answers.
constexpr std::uint64_t samples_that_share = 8;
// The film adds a pixel's samples in one loop: well below the 65,535 iterations after which
// lavapipe ends loops.
constexpr std::uint64_t most_samples_at_once = 1u << 14;
// Of the paths that ask the photon map, among EyeWorkspace::counts.
constexpr std::uint32_t asking_count = 2;
// Vertices recorded before the host asks whether any path is left.
constexpr int vertices_between_checks = 4;

QueryShareParams share_params(const EyeWorkspace& w, std::uint32_t asks, double cell,
                              bool pixel_sized) {
    QueryShareParams p{.pixel = 3e38f};
    p.asks = asks;
    p.cell = cell > 0 ? std::max(static_cast<float>(cell), 1e-30f) : 0;
    if (pixel_sized) {
        const double across =
            glm::length(glm::dvec3(w.view.across_x, w.view.across_y, w.view.across_z));
        p.pixel = static_cast<float>(across * w.view.origin_share);
        p.pixel_slope = static_cast<float>(across * (1 - w.view.origin_share));
        p.eye_x = w.view.origin_x;
        p.eye_y = w.view.origin_y;
        p.eye_z = w.view.origin_z;
    }
    p.mask = static_cast<std::uint32_t>(w.cells.size() / 4 - 1);
    return p;
}

/// Has the queries of the active paths answered that ask for `asks`, one for all that share a cell,
/// and adds to the paths' layers.
void ask(Device& device, EyeWorkspace& w, const Count& active, std::uint32_t asks,
         std::uint32_t part, double cell, bool pixel_sized, const Gather& gather) {
    const QueryShareParams params = share_params(w, asks, cell, pixel_sized);
    {
        const StageScope stage(device, "share queries");
        if (cell > 0) {
            device.fill(w.cells, no_query);
            device.fill(w.owners, no_query);
        }
        dispatch_indirect(device,
                          kernels::query_cells{.active_slots = w.active,
                                               .counts = w.counts,
                                               .asks = w.asks,
                                               .queries = w.queries,
                                               .table = w.cells,
                                               .owners = w.owners,
                                               .sources = w.sources,
                                               .params = params},
                          w.counts);
        dispatch_indirect(device,
                          kernels::query_owners{.active_slots = w.active,
                                                .counts = w.counts,
                                                .owners = w.owners,
                                                .asks = w.asks,
                                                .sources = w.sources,
                                                .chosen = w.chosen,
                                                .params = params},
                          w.counts);
    }
    {
        const StageScope stage(device, "compact");
        compact(device, w.chosen, w.active, w.asking, w.counts, asking_count, active);
    }
    gather(Count(w.counts, asking_count, active.bound), part);
    const StageScope stage(device, "share queries");
    dispatch_indirect(device,
                      kernels::estimate_add{.active_slots = w.active,
                                            .counts = w.counts,
                                            .sources = w.sources,
                                            .queries = w.queries,
                                            .estimates = w.estimates,
                                            .layers = w.layers},
                      w.counts);
}

/// Traces the paths of a batch to their end.
void trace_paths(Device& device, const DeviceScene& scene, EyeWorkspace& w, const Buffer& camera,
                 const EyeBatch& batch, const Gather& gather) {
    const Plan& plan = scene.plan;
    const std::uint64_t slots = std::uint64_t(batch.pixels) * batch.samples;
    device.fill(w.traversal.unfinished, 0);
    {
        const StageScope stage(device, "camera rays");
        dispatch(device,
                 kernels::camera_rays{.camera = camera,
                                      .rays = w.rays,
                                      .paths = w.paths,
                                      .layers = w.layers,
                                      .active_slots = w.active,
                                      .batch = batch},
                 slots);
        const auto count = static_cast<std::uint32_t>(slots);
        device.upload(w.counts, 0, std::as_bytes(std::span(&count, 1)));
    }
    for (int vertex = 1;; ++vertex) {
        const Count active(w.counts, 0, slots);
        {
            const StageScope stage(device, "trace eye rays");
            trace_closest(device, scene.bvh, w.traversal, w.rays, w.active, w.hits, active);
        }
        {
            const StageScope stage(device, "shade");
            dispatch_indirect(
                device,
                kernels::eye_vertex{
                    .scene = scene.scene,
                    .positions = scene.positions,
                    .normals = scene.normals,
                    .triangles = scene.triangles,
                    .materials = scene.materials,
                    .lights = scene.lights,
                    .light_choices = scene.light_choices,
                    .hits = w.hits,
                    .active_slots = w.active,
                    .counts = w.counts,
                    .rays = w.rays,
                    .paths = w.paths,
                    .layers = w.layers,
                    .shadow_rays = w.shadow_rays,
                    .shadows = w.shadows,
                    .queries = w.queries,
                    .alive = w.alive,
                    .asks = w.asks,
                    .batch = batch,
                    .constants = {.photon_map = gather != nullptr,
                                  .final_gather = w.final_gather,
                                  .followed_paths = plan.needs(Feature::followed_paths),
                                  .direct_light = plan.needs(Feature::direct_light),
                                  .smooth_normals = plan.needs(Feature::smooth_normals),
                                  .several_lights = plan.needs(Feature::several_lights),
                                  .light_kinds = plan.light_kinds(),
                                  .material_features = plan.material_features()}},
                w.counts);
        }
        if (plan.needs(Feature::direct_light)) {
            {
                const StageScope stage(device, "trace shadow rays");
                trace_any(device, scene.bvh, w.traversal, w.shadow_rays, w.active, w.occluded,
                          active);
            }
            const StageScope stage(device, "shade");
            dispatch_indirect(device,
                              kernels::shadow_add{.active_slots = w.active,
                                                  .counts = w.counts,
                                                  .occluded = w.occluded,
                                                  .shadows = w.shadows,
                                                  .layers = w.layers},
                              w.counts);
        }
        if (gather) {
            const QuerySharing& sharing = w.sharing;
            const double caustic_cell =
                sharing.caustics_apart && !sharing.sharp_caustics ? sharing.cell : 0;
            const bool apart = sharing.caustics_apart && !w.final_gather;
            ask(device, w, active, asks_map, apart ? map_indirect : map_whole, sharing.cell,
                sharing.pixel_sized, gather);
            if (apart) {
                ask(device, w, active, asks_map, map_caustic, caustic_cell, true, gather);
            } else if (w.final_gather && plan.needs(Feature::caustics)) {
                const std::uint32_t part = sharing.caustics_apart ? map_caustic : map_whole;
                ask(device, w, active, asks_caustics, part, caustic_cell, true, gather);
            }
        }
        {
            const StageScope stage(device, "compact");
            compact(device, w.alive, w.active, w.next_active, w.counts, 1, active);
            device.copy(BufferView(w.counts, 4, 4), BufferView(w.counts, 0, 4));
            std::swap(w.active, w.next_active);
        }
        device.submit();
        if (vertex % vertices_between_checks == 0 || (gather && vertex == 1)) {
            if (download<std::uint32_t>(device, w.counts, 1)[0] == 0) {
                break;
            }
        }
    }
}

/// One batch. The film is left alone if a ray or query ran out of iterations: the caller then
/// repeats it with care.
void trace_batch(Device& device, const DeviceScene& scene, EyeWorkspace& w, const EyeBatch& batch,
                 const Gather& gather) {
    trace_paths(device, scene, w, w.camera, batch, gather);
    const StageScope stage(device, "film");
    dispatch(device,
             kernels::film_add{.layers = w.layers,
                               .unfinished = w.traversal.unfinished,
                               .film = w.film[batch.first_pixel / w.film_pixels],
                               .batch = batch},
             batch.pixels);
}

} // namespace

EyeWorkspace make_eye_workspace(Device& device, const Plan& plan, const RenderSettings& settings,
                                const CameraRecord& camera) {
    const std::uint64_t pixels =
        std::uint64_t(settings.width) * static_cast<std::uint64_t>(settings.height);
    EyeWorkspace w;
    w.slots = std::min(device.info().lane_serial() ? slots_on_cpu : slots_on_gpu,
                       pixels * settings.samples);
    w.slots = std::min(w.slots, device.info().limits.storage_range /
                                    sizeof(GatherRecord)); // the largest per slot
    const auto per_slot = [&](const char* name, std::uint64_t bytes) {
        return device.allocate(name, w.slots * bytes);
    };
    // A kernel takes at least an element of each of its buffers.
    const auto per_slot_if = [&](bool needed, const char* name, std::uint64_t bytes) {
        return device.allocate(name, (needed ? w.slots : 1) * bytes);
    };
    const bool queries = plan.needs(Feature::photon_map);
    const bool direct = plan.needs(Feature::direct_light);
    w.final_gather = plan.needs(Feature::final_gather);
    w.view = camera;
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
    w.queries = per_slot_if(queries, "photon map queries", sizeof(QueryRecord));
    w.asks = per_slot_if(queries, "eye path flags", 4);
    if (queries) {
        w.chosen = per_slot("eye path flags", 4);
        w.asking = per_slot("asking eye paths", 4);
        w.estimates = per_slot("photon map answers", sizeof(EstimateRecord));
        w.partial = per_slot("unfinished query sums", sizeof(GatherRecord));
        w.sources = per_slot("photon map answers' slots", 4);
        const std::uint64_t entries = std::bit_ceil(w.slots + 1);
        w.cells = device.allocate("cells of queries", entries * 4);
        w.owners = device.allocate("owners of cells", entries * 4);
    }
    w.counts = device.allocate("eye path counts", 16);
    w.traversal = make_traversal(device, w.slots);
    w.film_pixels = device.info().limits.storage_range / sizeof(FilmRecord);
    for (std::uint64_t first = 0; first < pixels; first += w.film_pixels) {
        w.film.push_back(
            device.allocate("film", std::min(w.film_pixels, pixels - first) * sizeof(FilmRecord)));
        device.fill(w.film.back(), 0);
    }
    return w;
}

GatherTarget query_target(const EyeWorkspace& w, std::uint32_t part) {
    return {.slots = w.asking,
            .counts = w.counts,
            .queries = w.queries,
            .estimates = w.estimates,
            .partial = w.partial,
            .part = part,
            .final_gather = w.final_gather};
}

bool trace_eye_paths(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                     const RenderSettings& settings, std::uint32_t first_sample,
                     std::uint32_t samples, const Gather& gather, const OnProgress& progress) {
    const std::uint64_t pixels =
        std::uint64_t(settings.width) * static_cast<std::uint64_t>(settings.height);
    const std::uint64_t least_at_once = gather ? std::min(samples_that_share, w.slots) : 1;
    const std::uint64_t samples_at_once = std::min(
        {std::max(w.slots / pixels, least_at_once), std::uint64_t(samples), most_samples_at_once});
    const std::uint64_t pixels_at_once = std::min(pixels, w.slots / samples_at_once);
    const double batches = static_cast<double>(pixels) * samples;
    double done = 0;
    bool interrupted = false;
    for (std::uint64_t s = 0; s < samples; s += samples_at_once) {
        std::uint64_t p = 0;
        while (p < pixels) {
            EyeBatch batch{};
            batch.seed = settings.seed;
            batch.first_pixel = static_cast<std::uint32_t>(p);
            const std::uint64_t film_end = (p / w.film_pixels + 1) * w.film_pixels;
            batch.pixels =
                static_cast<std::uint32_t>(std::min({pixels_at_once, pixels - p, film_end - p}));
            batch.first_film_pixel = static_cast<std::uint32_t>(film_end - w.film_pixels);
            p += batch.pixels;
            batch.first_sample = first_sample + static_cast<std::uint32_t>(s);
            batch.samples =
                static_cast<std::uint32_t>(std::min<std::uint64_t>(samples_at_once, samples - s));
            batch.width = static_cast<std::uint32_t>(settings.width);
            batch.height = static_cast<std::uint32_t>(settings.height);
            batch.bounces = settings.bounces;
            batch.shares_queries = gather && w.sharing.cell > 0 ? 1 : 0;
            // A final gather's noise is that of the scattered directions: all of them ask.
            batch.query_step = w.final_gather ? 1 : samples_per_query;
            const std::uint32_t asking = (batch.samples + batch.query_step - 1) / batch.query_step;
            batch.query_weight = static_cast<float>(batch.samples) / static_cast<float>(asking);
            trace_batch(device, scene, w, batch, gather);
            if (!w.traversal.careful &&
                download<std::uint32_t>(device, w.traversal.unfinished, 1)[0] > 0) {
                w.traversal.careful = true;
                trace_batch(device, scene, w, batch, gather);
            }
            done += static_cast<double>(batch.pixels) * batch.samples;
            // Not in the middle: all pixels hold the same samples.
            interrupted = !progress(done / batches) || interrupted;
        }
        if (interrupted) {
            return false;
        }
    }
    return true;
}

std::vector<glm::vec3> sample_queries(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                                      const RenderSettings& settings, const Camera& camera) {
    constexpr int longer_side = 48;
    const int longer = std::max(settings.width, settings.height);
    EyeBatch batch{};
    batch.seed = settings.seed;
    batch.width = static_cast<std::uint32_t>(std::max(settings.width * longer_side / longer, 1));
    batch.height = static_cast<std::uint32_t>(std::max(settings.height * longer_side / longer, 1));
    batch.pixels =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(batch.width * batch.height, w.slots));
    batch.samples = 1;
    batch.bounces = settings.bounces;
    batch.query_step = 1;
    batch.query_weight = 1;
    const CameraRecord record =
        camera_record(camera, static_cast<int>(batch.width), static_cast<int>(batch.height));
    const Buffer small_picture = upload<CameraRecord>(device, "camera", std::span(&record, 1));
    std::vector<glm::vec3> positions;
    trace_paths(device, scene, w, small_picture, batch, [&](const Count& asking, std::uint32_t) {
        const auto count = download<std::uint32_t>(device, asking.buffer, 1, asking.index)[0];
        const std::vector<QueryRecord> queries =
            download<QueryRecord>(device, w.queries, batch.pixels);
        for (const std::uint32_t slot : download<std::uint32_t>(device, w.asking, count)) {
            if ((queries[slot].flags & query_caustics) == 0) {
                positions.emplace_back(queries[slot].x, queries[slot].y, queries[slot].z);
            }
        }
    });
    return positions;
}

std::vector<Layer> resolve_film(Device& device, const EyeWorkspace& w,
                                const RenderSettings& settings, RenderStatistics& statistics) {
    const std::size_t pixels =
        std::size_t(settings.width) * static_cast<std::size_t>(settings.height);
    std::vector<FilmRecord> film;
    film.reserve(pixels);
    for (const Buffer& part : w.film) {
        const std::size_t count = std::min<std::size_t>(w.film_pixels, pixels - film.size());
        const std::vector<FilmRecord> records = download<FilmRecord>(device, part, count);
        film.insert(film.end(), records.begin(), records.end());
    }
    std::vector<Layer> layers{{"", {}}, {"direct", {}}, {"indirect", {}}, {"caustic", {}}};
    for (Layer& layer : layers) {
        layer.image.width = settings.width;
        layer.image.height = settings.height;
        layer.image.pixels.resize(pixels);
    }
    statistics.non_finite = 0;
    statistics.samples = pixels > 0 ? film[0].samples : 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const FilmRecord& f = film[i];
        const std::uint32_t finite = f.samples - f.non_finite;
        const float scale = finite > 0 ? 1.0f / static_cast<float>(finite) : 0.0f;
        layers[1].image.pixels[i] = glm::vec3(f.direct_r, f.direct_g, f.direct_b) * scale;
        layers[2].image.pixels[i] = glm::vec3(f.indirect_r, f.indirect_g, f.indirect_b) * scale;
        layers[3].image.pixels[i] = glm::vec3(f.caustic_r, f.caustic_g, f.caustic_b) * scale;
        layers[0].image.pixels[i] =
            layers[1].image.pixels[i] + layers[2].image.pixels[i] + layers[3].image.pixels[i];
        statistics.non_finite += f.non_finite;
    }
    return layers;
}

} // namespace argand
