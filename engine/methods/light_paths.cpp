#include "methods/light_paths.hpp"

#include "kernels/connect_photons.hpp"
#include "kernels/splat_add.hpp"
#include "kernels/splat_keys.hpp"
#include "parallel/radix_sort.hpp"
#include "shared/light_path_records.h"

#include <algorithm>
#include <bit>

namespace argand {

namespace {

// Photons traced together. Splats of one pixel are added in one loop, which lavapipe ends after
// 65,535 iterations. All devices have as many, so that they add in the same order.
constexpr std::uint64_t most_slots = 65'000;

/// What the photons' hits are connected with.
struct Connection {
    Device& device;
    const DeviceScene& scene;
    LightPathWorkspace& workspace;
    EyeWorkspace& eye;
    ConnectParams params;
    std::uint32_t samples; ///< for which splats count
};

void connect_photons(const Connection& c, const Count& active) {
    const StageScope stage(c.device, "connect light paths");
    const LightPathWorkspace& w = c.workspace;
    const PhotonWorkspace& photons = w.photons;
    const Plan& plan = c.scene.plan;
    dispatch(c.device,
             kernels::connect_photons{
                 .scene = c.scene.bindings(),
                 .texture = c.scene.texture_bindings(),
                 .hits = photons.hits,
                 .active_slots = photons.active,
                 .counters = photons.counters,
                 .rays = photons.rays,
                 .paths = photons.paths,
                 .path_lights = photons.path_lights,
                 .light_paths = w.paths,
                 .camera = c.eye.camera,
                 .shadow_rays = w.shadow_rays,
                 .splats = w.splats,
                 .sky = c.scene.sky,
                 .params = c.params,
                 .constants = {.followed_paths = plan.needs(Feature::followed_paths),
                               .scene = c.scene.constants(),
                               .material_features = plan.material_features(),
                               .texture = c.scene.texture_constants()}},
             active);
}

/// Adds the splats whose shadow rays are not blocked to the film.
void add_splats(const Connection& c, const Count& active) {
    const StageScope stage(c.device, "add splats");
    LightPathWorkspace& w = c.workspace;
    const Film& film = c.eye.film;
    const auto none = static_cast<std::uint32_t>(2 * film.pixels());
    const bool has_alpha = c.scene.plan.needs(Feature::alpha);
    dispatch(c.device,
             kernels::splat_keys{.active_slots = w.photons.active,
                                 .counters = w.photons.counters,
                                 .occluded = w.occluded,
                                 .splats = w.splats,
                                 .keys = w.keys,
                                 .slots = w.slots,
                                 .params = {.none = none},
                                 .constants = {.has_alpha = has_alpha}},
             active);
    radix_sort_pairs(c.device, w.keys, w.slots, active,
                     static_cast<std::uint32_t>(std::bit_width(none)));
    for (std::uint64_t part = 0; part < film.parts.size(); ++part) {
        const std::uint64_t first = part * film.pixels_per_part;
        const std::uint64_t pixels = std::min(film.pixels_per_part, film.pixels() - first);
        dispatch(c.device,
                 kernels::splat_add{.keys = w.keys,
                                    .slots = w.slots,
                                    .counters = w.photons.counters,
                                    .occluded = w.occluded,
                                    .splats = w.splats,
                                    .film = film.parts[part],
                                    .params = {.first = static_cast<std::uint32_t>(first),
                                               .pixels = static_cast<std::uint32_t>(pixels),
                                               .none = none,
                                               .samples = static_cast<float>(c.samples)},
                                    .constants = {.has_alpha = has_alpha}},
                 active);
    }
}

ConnectParams connect_params(const EyeWorkspace& eye, const PhotonPass& pass,
                             const LightPathSamples& samples) {
    return {.seed = pass.seed,
            .bounces = pass.bounces,
            .photons = static_cast<float>(samples.photons),
            .width = eye.image_width,
            .height = eye.image_height,
            .crop_x = static_cast<std::uint32_t>(eye.crop.x0),
            .crop_y = static_cast<std::uint32_t>(eye.crop.y0),
            .crop_width = static_cast<std::uint32_t>(eye.crop.width()),
            .crop_height = static_cast<std::uint32_t>(eye.crop.height()),
            .samples = samples.last};
}

} // namespace

LightPathWorkspace make_light_path_workspace(Device& device, std::uint64_t photons) {
    LightPathWorkspace w;
    w.photons = make_photon_workspace(device, std::min(photons, most_slots),
                                      {.lights = true, .stores = false});
    // A batch that is traced again would add its splats again.
    w.photons.traversal.careful = true;
    const std::uint64_t slots = w.photons.slots;
    w.paths = device.allocate("light paths", slots * sizeof(LightPathRecord));
    w.shadow_rays = device.allocate("shadow rays to the eye", slots * sizeof(RayRecord));
    w.occluded = device.allocate("shadow ray flags", slots * 4);
    w.splats = device.allocate("splats", slots * sizeof(SplatRecord));
    w.keys = device.allocate("pixels of splats", slots * 4);
    w.slots = device.allocate("sorted splats", slots * 4);
    return w;
}

void trace_light_paths(Device& device, const DeviceScene& scene, LightPathWorkspace& w,
                       EyeWorkspace& eye, const PhotonPass& pass, float flux_unit,
                       const LightPathSamples& samples) {
    Connection c{.device = device,
                 .scene = scene,
                 .workspace = w,
                 .eye = eye,
                 .params = connect_params(eye, pass, samples),
                 .samples = samples.finished};
    trace_photons(device, scene, w.photons, pass, flux_unit,
                  [&](const PhotonBatch& batch, const Count& active) {
                      c.params.first = batch.first;
                      connect_photons(c, active);
                      {
                          const StageScope stage(device, "trace shadow rays");
                          trace_any(device, scene.bvh, w.photons.traversal,
                                    {w.shadow_rays, w.photons.active, w.occluded, active});
                      }
                      add_splats(c, active);
                  });
}

} // namespace argand
