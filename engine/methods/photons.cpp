#include "base/error.hpp"
#include "methods/bandwidth.hpp"
#include "methods/eye_paths.hpp"
#include "methods/next_pass.hpp"
#include "methods/streams.hpp"
#include "photon/gather.hpp"
#include "photon/nearest.hpp"
#include "plan/radius.hpp"

#include <algorithm>
#include <limits>

namespace argand {

namespace {

// A photon's mean flux in units of the fixed-point sums.
constexpr double units_per_photon = 1 << 18;
// The nearest ask for their own discs, of which many are smaller than the median: of r_max.
constexpr double sampled_by_nearest = 0.3;

void add_flux_sums(FluxSums& sums, const std::vector<std::int64_t>& words, double unit) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
        sums.emitted[channel] = words[channel];
        sums.absorbed[channel] = words[3 + channel];
        sums.escaped[channel] = words[6 + channel];
        sums.cut[channel] = words[9 + channel];
    }
    sums.unit = unit;
}

/// Passes over which photons and samples are spread. All count the same, so they must be of one
/// size: a small last one would be the noise of the picture. Each pass has a sample of its own, so
/// there are more samples than were asked for if there are more passes than that, or if they do not
/// divide.
struct Passes {
    std::uint64_t passes = 1;
    std::uint64_t photons = 1; ///< of the largest pass
    std::uint32_t samples = 1; ///< of each pass, per pixel
};

Passes split(std::uint64_t photons, std::uint32_t samples, std::uint64_t most) {
    Passes p;
    p.passes = std::max<std::uint64_t>((photons + most - 1) / most, 1);
    p.photons = std::max<std::uint64_t>((photons + p.passes - 1) / p.passes, 1);
    p.samples = static_cast<std::uint32_t>((samples + p.passes - 1) / p.passes);
    return p;
}

/// What all passes of a picture share.
struct Picture {
    Device& device;
    const Scene& scene;
    const RenderSettings& settings;
    Estimator estimator;
    DeviceScene on_device;
    EyeWorkspace eye;
    PhotonWorkspace photons;
    Passes passes;
    double flux_unit = 0;
};

/// Photons of each pass, whose number repeats if there is time for more.
PhotonPass emission_of(const Picture& p, const PassNumbers& numbers, std::uint64_t photons) {
    const std::uint64_t round = numbers.index / p.passes.passes;
    const std::uint64_t in_round = numbers.index % p.passes.passes;
    const std::uint64_t first = photons * in_round / p.passes.passes;
    return {.seed = numbers.seed,
            .first = round * photons + first,
            .count = photons * (in_round + 1) / p.passes.passes - first,
            .bounces = p.settings.bounces};
}

void make_photons(Picture& p) {
    p.photons = PhotonWorkspace(); // the old one's memory is free before the new one's is taken
    p.photons = make_photon_workspace(p.device, p.passes.photons,
                                      p.on_device.plan.needs(Feature::differentials));
    p.photons.quasi_random = p.settings.photon_sampling == Sampling::sobol;
    p.photons.reemission = p.settings.footprints.paper_reemission ? REEMIT_PAPER : REEMIT_COSINE;
    const double power = std::max({p.on_device.power.r, p.on_device.power.g, p.on_device.power.b});
    p.flux_unit = power / static_cast<double>(p.passes.photons) / units_per_photon;
}

std::optional<StoredPhotons> trace(Picture& p, const PhotonPass& emission) {
    return trace_photons(p.device, p.on_device, p.photons, emission,
                         static_cast<float>(p.flux_unit));
}

StoredPhotons stored_or_fail(const Picture& p, const std::optional<StoredPhotons>& stored) {
    if (!stored) {
        fail("rendering '{}': the photons that are stored exceed what '{}' can address; use fewer "
             "bounces or photons",
             p.scene.name, p.device.info().name);
    }
    return *stored;
}

/// Traces the photons of the first pass, of fewer if light is absorbed so little that every photon
/// is stored very often: later passes, which store a few photons more or less, are to fit as well.
StoredPhotons trace_first(Picture& p, std::uint64_t photons, Budget& budget) {
    p.passes = split(photons, p.settings.samples,
                     std::min(max_photons_per_pass(p.device), p.settings.photons_per_pass));
    for (;;) {
        make_photons(p);
        budget.start_pass();
        const std::optional<StoredPhotons> stored =
            trace(p, emission_of(p, {.seed = p.settings.seed}, photons));
        const bool has_room = stored && stored->slots <= max_stored_photons(p.device) / 10 * 9;
        if (has_room || p.passes.photons == 1) {
            return stored_or_fail(p, stored);
        }
        p.passes = split(photons, p.settings.samples, p.passes.photons / 2);
    }
}

/// Builds the map over the pass's photons, and traces eye paths that ask it. Returns false if
/// `progress` did.
bool render_pass(Picture& p, const StoredPhotons& stored, const PassNumbers& numbers,
                 const Bandwidth& bandwidth, RenderStatistics& statistics,
                 const OnProgress& progress) {
    Device& device = p.device;
    const bool nearest = p.estimator == Estimator::nearest;
    const double sampled = (nearest ? sampled_by_nearest : 1) * bandwidth.radii.indirect;
    if (p.estimator == Estimator::footprints) {
        statistics.footprint_scale =
            footprint_scale(bandwidth, p.settings.footprints, static_cast<double>(p.passes.photons),
                            p.on_device.record);
    }
    const PhotonMap map =
        build_photon_map(device, p.on_device, p.photons, stored,
                         {.area_samples = area_samples(p.on_device.surface_area, sampled),
                          .seed = numbers.seed + static_cast<std::uint32_t>(numbers.index),
                          .leaf_size = p.settings.footprints.leaf_size,
                          .wide_codes = p.settings.wide_codes,
                          .footprints = statistics.footprint_scale});
    statistics.mean_footprints = map.mean_footprints;
    statistics.leaf_size = map.leaf_size;
    statistics.radius = bandwidth.radii.indirect;
    statistics.caustic_radius = bandwidth.radii.caustic;
    statistics.neighbours = bandwidth.neighbours;
    statistics.smoothing = bandwidth.smoothing;
    // The nearest photons may be caustic ones, and then very near.
    p.eye.sharing = {.cell = p.settings.query_cell * sampled,
                     .pixel_sized = bandwidth.caustics && nearest};
    p.eye.sharing.sharp_caustics = bandwidth.radii.caustic < bandwidth.radii.indirect;
    const bool may_part = p.eye.sharing.cell > 0 || p.settings.final_gather;
    p.eye.sharing.caustics_apart =
        may_part && bandwidth.caustics && !nearest &&
        (p.eye.sharing.sharp_caustics || p.estimator == Estimator::footprints);
    const Gather gather = [&](const Count& asking, std::uint32_t part) {
        const GatherTarget target = query_target(p.eye, part);
        if (p.estimator == Estimator::footprints) {
            gather_footprints(device, p.on_device, map, target, p.eye.traversal,
                              p.settings.footprints.uniform_kernel, asking);
        } else if (nearest) {
            gather_nearest(
                device, p.on_device, map, target, p.eye.traversal,
                {.neighbours = bandwidth.neighbours,
                 .radius = bandwidth.radii.indirect,
                 .samples_per_area = map.area_samples / std::max(p.on_device.surface_area, 1e-30)},
                asking);
        } else {
            gather_photons(device, p.on_device, map, target, p.eye.traversal, bandwidth.radii,
                           asking);
        }
    };
    const auto first_sample = static_cast<std::uint32_t>(numbers.index * p.passes.samples);
    RenderSettings settings = p.settings;
    settings.seed = numbers.seed;
    return trace_eye_paths(device, p.on_device, p.eye, settings, first_sample, p.passes.samples,
                           gather, progress);
}

/// Photon mapping (Jensen 1996): photons from every light, a map of those that were scattered at
/// least once, density estimation where eye rays meet estimated lobes, direct light by shadow rays.
/// Each pass has its own photons and its own eye paths, so that memory is bounded.
RenderResult render_map(Device& device, const Scene& scene, const RenderSettings& settings,
                        const Listeners& listeners, Estimator estimator) {
    Budget budget(settings.budget);
    Picture p{.device = device,
              .scene = scene,
              .settings = settings,
              .estimator = estimator,
              .on_device = upload_scene(device, scene, plan_render(scene, settings)),
              .eye = {},
              .photons = {},
              .passes = {}};
    p.eye = make_eye_workspace(
        device, p.on_device.plan, settings,
        camera_record(scene.cameras[settings.camera], settings.width, settings.height));
    // Without indirect light no photon is ever looked up.
    const std::uint64_t photons =
        settings.bounces > 0 && p.on_device.record.light_count > 0 ? settings.photons : 0;
    StoredPhotons stored = trace_first(p, photons, budget);
    const std::uint64_t passes = p.passes.passes;
    const auto learnt_for = static_cast<double>(passes);
    const Bandwidth learnt = budget.once([&] {
        const std::vector<glm::vec3> queries =
            sample_queries(device, p.on_device, p.eye, settings, scene.cameras[settings.camera]);
        return learn_bandwidth(device, p.on_device, p.photons, stored, queries, settings, estimator,
                               learnt_for);
    });

    RenderResult result;
    RenderStatistics& statistics = result.statistics;
    const auto plan_next = [&] {
        const auto layers = [&] { return resolve_film(device, p.eye, settings, statistics); };
        return next_pass(listeners, budget, {statistics.passes, layers}, passes);
    };
    Streams streams(settings.seed);
    std::optional<PassPlan> plan = plan_next();
    for (std::uint64_t pass = 0; plan; ++pass) {
        const Bandwidth bandwidth = for_passes(learnt, learnt_for, plan->expected, settings);
        const PassNumbers numbers = streams.next(plan->stream);
        const PhotonPass emission = emission_of(p, numbers, photons);
        if (pass > 0) {
            stored = stored_or_fail(p, trace(p, emission));
        }
        statistics.interrupted =
            !render_pass(p, stored, numbers, bandwidth, statistics, [&](double part) {
                return tell_progress(listeners, budget, *plan, pass, part, passes);
            });
        statistics.photons_emitted += emission.count;
        statistics.photons_stored += stored.photons;
        ++statistics.passes;
        // Every pass emits all of the lights' power.
        add_flux_sums(statistics.flux, download<std::int64_t>(device, p.photons.flux_sums, 12),
                      p.flux_unit / static_cast<double>(statistics.passes));
        // Photons have numbers of 32 bits, beyond which they would be the same again.
        const PhotonPass next = emission_of(p, {.index = numbers.index + 1}, photons);
        const bool has_numbers = next.first + next.count <= 0xffffffffu &&
                                 has_sample_numbers(numbers.index + 1, p.passes.samples);
        plan = has_numbers && !statistics.interrupted ? plan_next() : std::nullopt;
    }
    result.layers = resolve_film(device, p.eye, settings, statistics);
    return result;
}

} // namespace

/// Over a fixed radius, as gathers of progressive photon mapping (Hachisuka et al. 2008).
RenderResult render_photons(Device& device, const Scene& scene, const RenderSettings& settings,
                            const Listeners& listeners) {
    return render_map(device, scene, settings, listeners, Estimator::radius);
}

/// Over each photon's own footprint (Fabianowski and Dingliana 2009).
RenderResult render_footprints(Device& device, const Scene& scene, const RenderSettings& settings,
                               const Listeners& listeners) {
    return render_map(device, scene, settings, listeners, Estimator::footprints);
}

/// Over the k nearest (Jensen 1996).
RenderResult render_nearest(Device& device, const Scene& scene, const RenderSettings& settings,
                            const Listeners& listeners) {
    return render_map(device, scene, settings, listeners, Estimator::nearest);
}

} // namespace argand
