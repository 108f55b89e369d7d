#include "methods/eye_paths.hpp"
#include "base/error.hpp"
#include "methods/methods.hpp"
#include "photon/gather.hpp"
#include "photon/nearest.hpp"
#include "plan/radius.hpp"
#include "plan/smoothing.hpp"
#include "shared/footprint.h"
#include "shared/photon.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace argand {

namespace {

// A photon's mean flux in units of the fixed-point sums.
constexpr double units_per_photon = 1 << 18;

void add_flux_sums(FluxSums& sums, const std::vector<std::int64_t>& words, double unit) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
        sums.emitted[channel] = words[channel];
        sums.absorbed[channel] = words[3 + channel];
        sums.escaped[channel] = words[6 + channel];
        sums.cut[channel] = words[9 + channel];
    }
    sums.unit = unit;
}

/// The radii for all passes, from the photons of the first and the points at which the picture will ask for them. The
/// radius of caustics follows from where their photons are, which is where the caustics are.
GatherRadii radii_from(Device& device, const DeviceScene& scene, PhotonWorkspace& workspace,
                       const StoredPhotons& stored, std::uint64_t passes, const std::vector<glm::vec3>& queries,
                       std::optional<std::uint32_t> neighbours) {
    constexpr std::size_t caustic_samples = 1024;
    const PhotonMap map = build_photon_map(device, scene, workspace, stored);
    const std::vector<PhotonRecord> photons = download<PhotonRecord>(device, map.photons, stored.photons);
    std::vector<PhotonRecord> caustic;
    std::copy_if(photons.begin(), photons.end(), std::back_inserter(caustic),
                 [](const PhotonRecord& photon) { return photon_is_caustic(photon.normal); });
    std::vector<glm::vec3> in_caustics;
    for (std::size_t i = 0; i < caustic.size(); i += std::max<std::size_t>(caustic.size() / caustic_samples, 1)) {
        in_caustics.emplace_back(caustic[i].x, caustic[i].y, caustic[i].z);
    }

    const glm::vec3 center(scene.record.center_x, scene.record.center_y, scene.record.center_z);
    const auto share = static_cast<double>(passes);
    const auto radius_of = [&](const std::vector<PhotonRecord>& some, const std::vector<glm::vec3>& points) {
        const double in_disc =
            neighbours ? *neighbours : photons_in_disc(static_cast<double>(some.size()) * share) / share;
        return median_radius(some, points, center - scene.record.radius, center + scene.record.radius, in_disc);
    };
    GatherRadii radii;
    // Without photons, or with all of them in one point, nothing is to be learnt.
    const double learnt = radius_of(photons, queries);
    radii.indirect = learnt > 0 ? learnt : 0.01 * scene.record.radius;
    const double learnt_of_caustics = radius_of(caustic, in_caustics);
    // Most of a caustic's photons lie where it is brightest; the few elsewhere would be seen one by one. And a radius
    // that is little smaller gains nothing, and loses the boundary correction.
    const bool sharp = learnt_of_caustics > 0 && learnt_of_caustics < 0.5 * radii.indirect;
    radii.caustic = sharp ? std::max(learnt_of_caustics, 0.25 * radii.indirect) : radii.indirect;
    return radii;
}

double smoothing_from(Device& device, const PhotonWorkspace& workspace, const StoredPhotons& stored,
                      std::uint64_t passes, const std::vector<glm::vec3>& queries, const FootprintScale& unit) {
    const auto photons = download<PhotonRecord>(device, workspace.photons, stored.slots);
    const auto offsets = download<glm::uvec4>(device, workspace.offsets, stored.slots);
    const auto share = static_cast<double>(passes);
    // For as little noise as discs of one size: footprints of different sizes do not count the same.
    const double on_point = 4.0 / 3 * photons_in_disc(static_cast<double>(stored.photons) * share) / share;
    const double learnt = median_smoothing(photons, offsets, queries, unit, on_point);
    return learnt > 0 ? learnt : 1;
}

/// Semi-axes of caustic photons' footprints, in the radius that would serve for all caustics.
constexpr float least_caustic = 0.2f;
constexpr float most_caustic = 8;

/// Photons at which a given smoothing holds.
constexpr double reference_photons = 200'000;

FootprintScale scale_of(const FootprintSettings& settings, double photons, double smoothing, double largest,
                        const SceneRecord& scene) {
    FootprintScale scale =
        make_footprint_scale(static_cast<float>(photons), static_cast<float>(reference_photons), scene.radius,
                             static_cast<float>(smoothing), static_cast<float>(settings.caustic_smoothing),
                             static_cast<float>(largest), static_cast<float>(settings.flatness),
                             settings.fixed_smoothing ? 0.5f : 1.0f / 6.0f);
    scale.principal_axes = settings.paper_axes ? 0 : 1;
    return scale;
}

struct Passes {
    std::uint64_t passes = 1;
    std::uint64_t photons = 1;  ///< of the largest pass
};

/// Passes of at most so many photons. All count the same, so they must be of one size: a small last one would be the
/// noise of the picture.
Passes split_photons(std::uint64_t photons, std::uint64_t most) {
    Passes split;
    split.passes = std::max<std::uint64_t>((photons + most - 1) / most, 1);
    split.photons = std::max<std::uint64_t>((photons + split.passes - 1) / split.passes, 1);
    return split;
}

PhotonWorkspace make_workspace(Device& device, const RenderSettings& settings, std::uint64_t photons,
                               bool footprints) {
    PhotonWorkspace workspace = make_photon_workspace(device, photons, footprints);
    workspace.reemission = settings.footprints.paper_reemission ? REEMIT_PAPER : REEMIT_COSINE;
    return workspace;
}

/// Whether later passes, which store a few photons more or less, will fit as well.
bool has_room(const Device& device, const std::optional<StoredPhotons>& stored) {
    return stored && stored->slots <= max_stored_photons(device) / 10 * 9;
}

// r_max of the nearest photons, in radii that hold k of them where photons are as dense as in the median.
constexpr double reach_of_nearest = 2.5;

/// How radiance is estimated from the map.
enum class Estimator { radius, footprints, nearest };

/// k of one pass, from the photons of the first.
std::uint32_t neighbours_of(const RenderSettings& settings, std::uint64_t photons, std::uint64_t passes) {
    const auto share = static_cast<double>(passes);
    const double automatic = std::round(photons_in_disc(static_cast<double>(photons) * share) / share);
    return settings.neighbours.value_or(static_cast<std::uint32_t>(std::max(automatic, 2.0)));
}

/// Photon mapping (Jensen 1996): photons from every light, a map of those that were scattered at least once, density
/// estimation within a radius where eye rays meet estimated lobes, direct light by shadow rays. Each pass has its own
/// photons and its own eye paths, so that memory is bounded.
RenderResult render_map(Device& device, const Scene& scene, const RenderSettings& settings, const OnProgress& progress,
                        Estimator estimator) {
    const bool footprints = estimator == Estimator::footprints;
    const bool nearest = estimator == Estimator::nearest;
    const DeviceScene on_device = upload_scene(device, scene, settings.follow_roughness);
    RenderResult result;
    RenderStatistics& statistics = result.statistics;
    GatherRadii radii;

    EyeWorkspace eye = make_eye_workspace(
        device, settings, camera_record(scene.cameras[settings.camera], settings.width, settings.height), true);
    const Buffer partial = device.allocate("unfinished query sums", eye.slots * sizeof(GatherRecord));

    // Without indirect light no photon is ever looked up.
    const std::uint64_t photons = settings.bounces > 0 && on_device.record.light_count > 0 ? settings.photons : 0;
    Passes split = split_photons(photons, max_photons_per_pass(device));
    PhotonWorkspace workspace = make_workspace(device, settings, split.photons, footprints);
    std::optional<FootprintScale> scale;
    double power = std::max({on_device.power.r, on_device.power.g, on_device.power.b});
    for (std::uint64_t pass = 0; pass < split.passes && !statistics.interrupted; ++pass) {
        const std::uint64_t passes = split.passes;
        const auto samples = static_cast<std::uint32_t>((settings.samples + passes - 1) / passes);
        const PhotonPass emission{.seed = settings.seed, .first = statistics.photons_emitted,
                                  .count = photons * (pass + 1) / passes - photons * pass / passes,
                                  .bounces = settings.bounces};
        const double unit = power / static_cast<double>(split.photons) / units_per_photon;
        const std::optional<StoredPhotons> stored =
            trace_photons(device, on_device, workspace, emission, static_cast<float>(unit));
        if (pass == 0 && split.photons > 1 && !has_room(device, stored)) {
            // Light that is absorbed so little that every photon is stored very often.
            split = split_photons(photons, split.photons / 2);
            workspace = PhotonWorkspace();
            workspace = make_workspace(device, settings, split.photons, footprints);
            --pass;
            continue;
        }
        if (!stored) {
            fail("rendering '{}': the photons that are stored exceed what '{}' can address; use fewer bounces or photons",
                 scene.name, device.info().name);
        }
        if (pass == 0) {
            const std::vector<glm::vec3> queries =
                sample_queries(device, on_device, eye, settings, scene.cameras[settings.camera]);
            radii = settings.radius ? GatherRadii{*settings.radius, *settings.radius}
                                    : radii_from(device, on_device, workspace, *stored, passes, queries,
                                                 nearest ? settings.neighbours : std::nullopt);
            if (nearest) {
                statistics.neighbours = neighbours_of(settings, stored->photons, passes);
                radii.indirect *= settings.radius ? 1 : reach_of_nearest;
                radii.caustic = radii.indirect;
            }
            statistics.radius = radii.indirect;
            statistics.caustic_radius = radii.caustic;
            if (footprints) {
                const FootprintSettings& f = settings.footprints;
                const auto of_pass = static_cast<double>(split.photons);
                statistics.smoothing =
                    f.smoothing ? *f.smoothing
                                : smoothing_from(device, workspace, *stored, passes, queries,
                                                 scale_of(f, of_pass, 1, 1e6, on_device.record));
                // A few large footprints cost more than they are worth, for their boxes are everywhere.
                const double largest = f.largest.value_or(1.25 * radii.indirect / on_device.record.radius);
                scale = scale_of(f, of_pass, statistics.smoothing, largest, on_device.record);
                // Where a caustic folds, its photons' footprints shrink to lines and points: bright streaks and dots,
                // for there the linear map of the differentials holds in a small neighbourhood only.
                scale->caustic_min = std::max(scale->radius_min, least_caustic * static_cast<float>(radii.caustic));
                scale->caustic_max = std::max(scale->caustic_min, most_caustic * static_cast<float>(radii.caustic));
            }
        }
        // The nearest ask for their own discs, of which many are smaller than the median.
        const double sampled = nearest ? 0.75 / reach_of_nearest * statistics.radius : statistics.radius;
        const PhotonMap map = build_photon_map(
            device, on_device, workspace, *stored,
            {.area_samples = area_samples(on_device.surface_area, sampled),
             .seed = settings.seed + static_cast<std::uint32_t>(pass), .leaf_size = settings.footprints.leaf_size,
             .footprints = scale});
        statistics.mean_footprints = map.mean_footprints;
        statistics.leaf_size = map.leaf_size;
        statistics.footprint_scale = scale;
        const Gather gather = [&](const Count& asking) {
            const GatherTarget target{.slots = eye.asking, .counts = eye.counts, .queries = eye.queries,
                                      .layers = eye.layers, .partial = partial};
            if (footprints) {
                gather_footprints(device, on_device, map, target, eye.traversal, settings.footprints.uniform_kernel,
                                  asking);
            } else if (nearest) {
                gather_nearest(device, on_device, map, target, eye.traversal,
                               {.neighbours = statistics.neighbours, .radius = radii.indirect,
                                .samples_per_area = map.area_samples / std::max(on_device.surface_area, 1e-30)},
                               asking);
            } else {
                gather_photons(device, on_device, map, target, eye.traversal, radii, asking);
            }
        };
        const auto first_sample = static_cast<std::uint32_t>(pass * samples);
        statistics.interrupted =
            !trace_eye_paths(device, on_device, eye, settings, first_sample, samples, gather, [&](double share) {
                return progress((static_cast<double>(pass) + share) / static_cast<double>(passes));
            });
        statistics.photons_emitted += emission.count;
        statistics.photons_stored += stored->photons;
        ++statistics.passes;
        // Every pass emits all of the lights' power.
        add_flux_sums(statistics.flux, download<std::int64_t>(device, workspace.flux_sums, 12),
                      unit / static_cast<double>(statistics.passes));
    }
    result.layers = resolve_film(device, eye, settings, statistics);
    return result;
}

} // namespace

RenderResult render_photons(Device& device, const Scene& scene, const RenderSettings& settings,
                            const OnProgress& progress) {
    return render_map(device, scene, settings, progress, Estimator::radius);
}

RenderResult render_footprints(Device& device, const Scene& scene, const RenderSettings& settings,
                               const OnProgress& progress) {
    return render_map(device, scene, settings, progress, Estimator::footprints);
}

RenderResult render_nearest(Device& device, const Scene& scene, const RenderSettings& settings,
                            const OnProgress& progress) {
    return render_map(device, scene, settings, progress, Estimator::nearest);
}

} // namespace argand
