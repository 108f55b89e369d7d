#include "methods/photon_mapping.hpp"

#include "base/error.hpp"
#include "methods/bandwidth.hpp"
#include "methods/near_field.hpp"
#include "methods/persist_buffer.hpp"
#include "methods/photon_numbers.hpp"
#include "methods/photon_targets.hpp"
#include "methods/sample_parts.hpp"
#include "methods/search_options.hpp"
#include "methods/small_image.hpp"
#include "methods/traced_photons.hpp"
#include "methods/view_areas.hpp"
#include "photon/photon_map.hpp"
#include "photon/radius.hpp"
#include "shared/photon.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace argand {

namespace {

// Photons of a pass over the most of a first pass.
constexpr std::uint64_t most_growth = 8;

/// How photons and samples are spread over photon maps. All maps count the same, so they are of one
/// size: the noise of a small last one would be the noise of the image. Each map serves at least
/// one sample, so the image has more samples than the settings request if there are more maps than
/// that, or if samples do not divide evenly. The samples of a map may be divided into passes
/// (SampleParts).
struct MapSplit {
    std::uint64_t maps = 1;
    std::uint64_t photons = 1; ///< of the largest map
    std::uint32_t samples = 1; ///< that each map serves, per pixel
};

MapSplit split(const RenderSettings& settings, std::uint64_t photons, std::uint64_t most_photons) {
    MapSplit s;
    most_photons = std::clamp<std::uint64_t>(most_photons, 1, numbers_of_seed);
    const std::uint64_t wanted =
        std::max({std::uint64_t(settings.least_passes), (photons + most_photons - 1) / most_photons,
                  std::uint64_t(1)});
    // A pass without photons would have no indirect light.
    s.maps = photons > 0 ? std::min(wanted, photons) : wanted;
    s.photons = std::max<std::uint64_t>((photons + s.maps - 1) / s.maps, 1);
    s.samples = static_cast<std::uint32_t>((settings.samples + s.maps - 1) / s.maps);
    return s;
}

/// What belongs to one image.
struct ImageState {
    std::uint64_t emitted = 0; ///< photons of the whole image, as the settings request
    MapSplit split;
    double flux_unit = 0;  ///< of the fixed-point sums
    Bandwidth learnt;      ///< for split.maps maps; progressive: for the first one
    double view_reach = 0; ///< distance from the camera, see view_areas.hpp
    // Of the last map.
    PhotonPass emission; ///< all but the bounces, which the settings have
    Bandwidth bandwidth;
    std::optional<FootprintScale> footprint_scale;
    double mean_footprints = 0;
    std::uint32_t leaf_size = 0;
    // Of all maps.
    std::uint64_t maps = 0, photons_emitted = 0, photons_stored = 0;
    std::uint64_t paths = 0; ///< of photons, also those that the dark has not emitted
    PhotonNumbers numbers;
    // Of the first map.
    std::uint64_t first_paths = 0;
    std::uint64_t most_photons = 1; ///< of a pass of which the law asks for more than for the first
    double in_view = 0;             ///< photons stored in view per photon emitted
    std::optional<Untaken> untaken; ///< learn_untaken() of the first map with area samples
};

void persist_image(Archive& archive, ImageState& image) {
    archive.value(image.emitted);
    archive.value(image.split.maps);
    archive.value(image.split.photons);
    archive.value(image.split.samples);
    archive.value(image.flux_unit);
    persist_bandwidth(archive, image.learnt);
    archive.value(image.view_reach);
    archive.value(image.emission.seed);
    archive.value(image.emission.first);
    archive.value(image.emission.count);
    persist_bandwidth(archive, image.bandwidth);
    archive.optional(image.footprint_scale);
    archive.value(image.mean_footprints);
    archive.value(image.leaf_size);
    archive.value(image.maps);
    archive.value(image.photons_emitted);
    archive.value(image.photons_stored);
    archive.value(image.paths);
    image.numbers.persist(archive);
    archive.value(image.first_paths);
    archive.value(image.most_photons);
    archive.value(image.in_view);
    archive.optional(image.untaken);
}

class PhotonMapping : public Method {
public:
    PhotonMapping(RenderContext& context, std::unique_ptr<EstimationStrategy> strategy,
                  bool progressive, std::unique_ptr<TracingStrategy> tracing)
        : c_(context), strategy_(std::move(strategy)), tracing_(std::move(tracing)),
          progressive_(progressive) {}

    void begin_frame(Budget& budget) override {
        image_ = {};
        made_ = nullptr;
        view_points_.reset();
        // Without bounces no photon is ever looked up.
        image_.emitted = c_.settings.bounces > 0 ? c_.settings.photons : 0;
        const std::vector<glm::vec4> queries = sample_queries(
            c_.device, c_.on_device, c_.eye, c_.settings, c_.scene.cameras[c_.settings.camera]);
        if (tracing_) {
            tracing_->begin_frame(c_, queries);
        }
        aim_at_casters(c_, queries);
        if (strategy_->takes_uneven_photons()) {
            aim_at_view(c_, queries);
        }
        begin_near_field(c_, queries, may_follow_near());
        first_ = trace_first(budget);
        image_.learnt = budget.once([&] {
            const SortedPhotons sorted = sort_photons(c_.device, photons_, *first_);
            const FirstPass first{.device = c_.device,
                                  .scene = c_.on_device,
                                  .workspace = photons_,
                                  .stored = *first_,
                                  .photons = sorted,
                                  .queries = queries,
                                  .passes =
                                      progressive_ ? 1 : static_cast<double>(image_.split.maps),
                                  .evenness = evenness_in_view(c_, photons_, *first_)};
            RenderSettings settings = c_.settings;
            if (progressive_) {
                settings.radius = settings.progressive.first_radius;
            }
            const Bandwidth learnt = strategy_->learn(first, settings);
            image_.view_reach = reach_of_view(queries, c_.scene.cameras[c_.settings.camera]);
            sample_areas_in_view(c_, image_.view_reach, strategy_->typical_radius(learnt), 1);
            return learnt;
        });
        image_.in_view = in_view_per_emitted(c_, photons_, *first_, queries);
    }

    std::uint64_t passes() const override {
        return image_.split.maps * parts().count *
               (progressive_ ? c_.settings.progressive.passes : 1);
    }

    bool pass(const Pass& pass, const OnProgress& on_part) override;

    std::uint64_t passes_per_seed() const override {
        return numbers_of_seed /
               std::max<std::uint64_t>(image_.split.photons, image_.split.samples) * parts().count;
    }

    void persist(Archive& archive) override;
    std::string describe_pass() const override;
    void report(RenderStatistics& statistics) const override;

private:
    std::uint64_t photons_requested(std::uint64_t index) const;
    PhotonPass next_emission(const Pass& pass);
    void set_bandwidth(const Pass& pass, std::uint64_t photons);
    void begin_workspace();
    void make_room(std::uint64_t photons);
    std::optional<StoredPhotons> trace(PhotonPass emission);
    StoredPhotons stored_or_fail(const std::optional<StoredPhotons>& stored) const;
    StoredPhotons trace_first(Budget& budget);
    bool goes_on() const;
    bool may_follow_near() const;
    double area_share() const;
    PhotonMap build_map(const PassNumbers& numbers, const StoredPhotons& stored);
    StoredPhotons trace_again();
    void make_map(const Pass& pass);
    void make_estimator(const PassNumbers& numbers, const StoredPhotons& stored);

    /// Of the samples that a map serves. Widths that fall from pass to pass have a map for each.
    SampleParts parts() const {
        const std::uint32_t samples = image_.split.samples;
        return progressive_ ? SampleParts{.count = 1, .samples = samples}
                            : divide_samples(c_.settings, c_.eye, samples);
    }

    RenderContext& c_;
    std::unique_ptr<EstimationStrategy> strategy_;
    std::unique_ptr<TracingStrategy> tracing_; ///< null: rays go through the scene's tree
    bool progressive_;                         ///< widths fall from pass to pass
    PhotonWorkspace photons_;
    std::uint64_t room_ = 0; ///< photons of a pass for which the workspace was made
    ImageState image_;
    std::optional<StoredPhotons> first_; ///< traced before the first pass, which uses them up
    /// The last map, until all of its samples are traced; null after a load.
    std::unique_ptr<MadeMap> made_;
    std::optional<ViewPoints> view_points_; ///< none before the first map, and after a load
};

/// The photons of the map with this index, as the settings request them. If there are more maps
/// than that, they repeat.
std::uint64_t PhotonMapping::photons_requested(std::uint64_t index) const {
    const std::uint64_t in_round = index % image_.split.maps;
    return image_.emitted * (in_round + 1) / image_.split.maps -
           image_.emitted * in_round / image_.split.maps;
}

/// The photons of the next pass if there is light, with numbers that no pass has had. Where k
/// cannot fall with the radius, there are more photons instead.
PhotonPass PhotonMapping::next_emission(const Pass& pass) {
    std::uint64_t photons = photons_requested(pass.numbers.index);
    if (progressive_ && !pass.keeps_width && image_.maps > 0) {
        const double so_far =
            static_cast<double>(image_.paths) / static_cast<double>(image_.first_paths);
        const double growth =
            photon_growth(image_.learnt, so_far, c_.settings.progressive.exponent);
        const double most = static_cast<double>(std::max(image_.most_photons, photons));
        photons = static_cast<std::uint64_t>(
            std::min(std::round(growth * static_cast<double>(photons)), most));
    }
    PhotonPass emission = image_.numbers.next(pass.numbers.seed, photons);
    emission.bounces = c_.settings.bounces;
    return emission;
}

/// Makes the workspace of a pass of this many photons, and keeps the sums of flux. Its size follows
/// from the pass alone, not from those before: batches of photons decide their order.
void PhotonMapping::make_room(std::uint64_t photons) {
    const std::uint64_t least = image_.split.photons;
    const std::uint64_t room =
        std::max(std::min(least * std::bit_ceil((photons + least - 1) / least),
                          max_photons_per_pass(c_.device)),
                 least);
    if (room_ == room) {
        return;
    }
    const Buffer sums = photons_.flux_sums;
    photons_ = PhotonWorkspace(); // frees the old one's memory before the new one takes its own
    const std::uint32_t extents =
        strategy_->splats() ? extents_splats : extents_of(c_.on_device.plan);
    photons_ = make_photon_workspace(c_.device, room, {.extents = extents});
    photons_.numbers = kind_of_photon_numbers(c_.settings);
    photons_.reemission = c_.settings.footprints.paper_reemission ? REEMIT_PAPER : REEMIT_COSINE;
    if (tracing_) {
        photons_.tracer = tracing_->tracer(c_);
    }
    if (sums) {
        photons_.flux_sums = sums;
    }
    room_ = room;
}

/// Readies the workspace for the first pass of an image.
void PhotonMapping::begin_workspace() {
    make_room(image_.split.photons);
    c_.device.fill(photons_.flux_sums, 0);
    image_.flux_unit = flux_unit_for(c_.on_device, image_.split.photons);
}

std::optional<StoredPhotons> PhotonMapping::trace(PhotonPass emission) {
    make_room(emission.count);
    if (tracing_) {
        tracing_->follow(c_);
    }
    emission.count = c_.on_device.record.light_count > 0 ? emission.count : 0;
    return trace_photons(c_.device, c_.on_device, photons_, emission,
                         static_cast<float>(image_.flux_unit));
}

StoredPhotons PhotonMapping::stored_or_fail(const std::optional<StoredPhotons>& stored) const {
    if (!stored) {
        fail("rendering '{}': the photons that are stored exceed what '{}' can address; use fewer "
             "bounces or photons",
             c_.scene.name, c_.device.info().name);
    }
    return *stored;
}

/// Traces the photons of the first pass. Light that is hardly absorbed stores every photon very
/// often; passes then have fewer photons, so that later ones, which store a few more or less, fit
/// as well. The same holds for passes of more photons than the first one.
StoredPhotons PhotonMapping::trace_first(Budget& budget) {
    image_.split = split(c_.settings, image_.emitted,
                         std::min(max_photons_per_pass(c_.device), c_.settings.photons_per_pass));
    const std::uint64_t room = max_stored_photons(c_.device) / 10 * 9;
    for (;;) {
        begin_workspace();
        budget.start_pass();
        PhotonPass emission = PhotonNumbers().next(c_.settings.seed, photons_requested(0));
        emission.bounces = c_.settings.bounces;
        const std::optional<StoredPhotons> stored = trace(emission);
        if ((stored && stored->slots <= room) || image_.split.photons == 1) {
            image_.most_photons = std::min(
                {most_growth * c_.settings.photons_per_pass, max_photons_per_pass(c_.device),
                 room / std::max<std::uint64_t>(stored_or_fail(stored).slots, 1) *
                     image_.split.photons});
            if (learn_near_field(c_, *stored)) {
                continue;
            }
            return *stored;
        }
        image_.split = split(c_.settings, image_.emitted, image_.split.photons / 2);
    }
}

/// Whether eye paths go on where the map's estimate is not taken.
bool PhotonMapping::goes_on() const {
    return least_coverage_of(c_.settings) > 0 && c_.on_device.plan.needs(Feature::direct_light);
}

/// Whether eye paths may follow the light of nearby surfaces: their rays go on behind estimates,
/// and hits are exact.
bool PhotonMapping::may_follow_near() const {
    return image_.emitted > 0 && goes_on() && strategy_->corrects_boundaries(c_.settings) &&
           !strategy_->splats() && !tracing_;
}

/// Share of the area samples that discs get. Where widths fall from pass to pass, it falls with the
/// photons that discs hold: a pass alone is noisier anyway, and samples for their full number would
/// soon take most of the time.
double PhotonMapping::area_share() const {
    const double by =
        progressive_ ? image_.bandwidth.radii.indirect / image_.learnt.radii.indirect : 1;
    return std::clamp(by * by, least_area_share, 1.0);
}

PhotonMap PhotonMapping::build_map(const PassNumbers& numbers, const StoredPhotons& stored) {
    image_.footprint_scale =
        strategy_->footprints(image_.bandwidth, c_.settings.footprints,
                              static_cast<double>(image_.split.photons), c_.on_device.record);
    const double radius = strategy_->typical_radius(image_.bandwidth);
    std::uint64_t samples = 0;
    if (strategy_->corrects_boundaries(c_.settings)) {
        sample_areas_in_view(c_, image_.view_reach, radius, area_share());
        samples = area_samples(c_.on_device.areas.area, radius, area_share());
        // With several moments, what is in view moves from pass to pass.
        if (goes_on() && (!view_points_ || c_.settings.least_passes > 1)) {
            view_points_ = sample_view_points(c_.device, c_.on_device, c_.eye, c_.settings,
                                              c_.scene.cameras[c_.settings.camera],
                                              image_.learnt.radii.indirect);
        }
    }
    PhotonMap map = build_photon_map(c_.device, c_.on_device, photons_, stored,
                                     {.area_samples = samples,
                                      .cover_height = disc_half_height * radius,
                                      .drops_covered = goes_on(),
                                      .view = view_points_ ? &*view_points_ : nullptr,
                                      .seed = area_seed(numbers),
                                      .leaf_size = c_.settings.leaf_size,
                                      .wide_codes = c_.settings.wide_codes,
                                      .footprints = image_.footprint_scale,
                                      .uniform_kernel = strategy_->splats()
                                                            ? c_.settings.disc.uniform_kernel
                                                            : c_.settings.footprints.uniform_kernel,
                                      .caustic_radius = strategy_->caustic_discs(image_.bandwidth),
                                      .frontier = frontier_of(c_.settings)});
    image_.mean_footprints = map.mean_footprints;
    image_.leaf_size = map.leaf_size;
    return map;
}

/// Sets the bandwidth of the next pass. Of widths that fall from pass to pass, r(n) = r1
/// (n/n1)^(-a), where n counts the photon paths of all passes so far and of this one, as in Keller
/// et al. 2010, section 1, and n1 those of the first pass.
void PhotonMapping::set_bandwidth(const Pass& pass, std::uint64_t photons) {
    const std::uint64_t paths = std::max<std::uint64_t>(photons, 1);
    image_.paths += paths;
    image_.first_paths = image_.maps > 0 ? image_.first_paths : paths;
    if (!progressive_) {
        image_.bandwidth = for_passes(image_.learnt, static_cast<double>(image_.split.maps),
                                      pass.expected, c_.settings);
        return;
    }
    const double times = pass.keeps_width ? pass.expected
                                          : static_cast<double>(image_.paths) /
                                                static_cast<double>(image_.first_paths);
    image_.bandwidth =
        narrowed(image_.learnt, std::pow(times, -c_.settings.progressive.exponent),
                 static_cast<double>(paths) / static_cast<double>(image_.first_paths),
                 c_.on_device.record.radius);
}

/// Makes the map of the next photons.
void PhotonMapping::make_map(const Pass& pass) {
    image_.emission = next_emission(pass);
    set_bandwidth(pass, image_.emission.count);
    const StoredPhotons stored = first_ ? *first_ : stored_or_fail(trace(image_.emission));
    first_.reset();
    make_estimator(pass.numbers, stored);
    ++image_.maps;
    image_.photons_emitted += c_.on_device.record.light_count > 0 ? image_.emission.count : 0;
    image_.photons_stored += stored.photons;
}

void PhotonMapping::make_estimator(const PassNumbers& numbers, const StoredPhotons& stored) {
    made_ = std::make_unique<MadeMap>();
    made_->map = build_map(numbers, stored);
    const double cell = c_.settings.query_cell * strategy_->typical_radius(image_.bandwidth);
    c_.eye.queries.sharing = {.cell = cell,
                              .caustics_apart = strategy_->parts_caustics(
                                  image_.bandwidth, cell > 0 || c_.settings.final_gather),
                              .sharp_caustics = has_sharp_caustics(image_.bandwidth)};
    made_->estimator = strategy_->make(c_, made_->map, image_.bandwidth);
    made_->gathers = strategy_->make_for_gathers(c_, image_.bandwidth);
    if (c_.on_device.record.follows_near != 0) {
        image_.untaken = {untaken_often, Untaken::mildly_uneven, least_coverage_of(c_.settings)};
    } else if (!image_.untaken && made_->map.area_samples > 0) {
        image_.untaken = learn_untaken(c_.device, c_.on_device, c_.eye, c_.settings,
                                       c_.scene.cameras[c_.settings.camera], made_->lookup());
    }
    made_->untaken = image_.untaken.value_or(Untaken{});
}

/// Traces the photons of the last map once more, after a load. Their flux is in the sums already.
StoredPhotons PhotonMapping::trace_again() {
    PhotonPass emission = image_.emission;
    emission.bounces = c_.settings.bounces;
    make_room(emission.count);
    const Buffer sums = photons_.flux_sums;
    photons_.flux_sums =
        c_.device.allocate("sums of flux traced again", flux_words * sizeof(std::int64_t));
    const StoredPhotons stored = stored_or_fail(trace(emission));
    photons_.flux_sums = sums;
    return stored;
}

bool PhotonMapping::pass(const Pass& pass, const OnProgress& on_part) {
    const SampleParts parts = this->parts();
    const std::uint64_t part = pass.numbers.index % parts.count;
    Pass of_map = pass;
    of_map.numbers.index /= parts.count;
    of_map.expected /= static_cast<double>(parts.count);
    if (part == 0) {
        make_map(of_map);
    } else if (!made_) {
        make_estimator(of_map.numbers, trace_again());
    }
    const PhotonLookup lookup = made_->lookup();
    const EyePass eye{.seed = pass.numbers.seed,
                      .first_sample =
                          static_cast<std::uint32_t>(of_map.numbers.index * image_.split.samples),
                      .samples = image_.split.samples,
                      .bounces = c_.settings.bounces};
    // Only these paths: others learn for the next map or image, whose surfaces and lights may be
    // elsewhere.
    if (tracing_) {
        c_.eye.tracers = tracing_->eye_tracers(c_);
    }
    const bool finished = trace_eye_paths(c_.device, c_.on_device, c_.eye,
                                          part_of(eye, parts, part), &lookup, on_part);
    c_.eye.tracers = {};
    if (!finished || part + 1 == parts.count) {
        made_ = nullptr; // frees its memory before the next one takes its own
    }
    return finished;
}

void PhotonMapping::persist(Archive& archive) {
    persist_image(archive, image_);
    const MapSplit& split = image_.split;
    const std::uint64_t emitted = c_.settings.bounces > 0 ? c_.settings.photons : 0;
    if (image_.emitted != emitted || split.maps == 0 || split.photons == 0 || split.samples == 0 ||
        split.photons < emitted / split.maps ||
        split.photons > std::max<std::uint64_t>(max_photons_per_pass(c_.device), 1) ||
        image_.most_photons > max_photons_per_pass(c_.device) ||
        image_.emission.count > std::max(split.photons, image_.most_photons) ||
        (image_.maps > 0 && image_.first_paths == 0)) {
        fail("loading a saved state: it is not one of photon mapping on '{}'",
             c_.device.info().name);
    }
    if (tracing_) {
        tracing_->persist(archive, c_);
    }
    if (archive.loads()) {
        first_.reset();
        made_ = nullptr;
        view_points_.reset();
        make_room(split.photons);
    }
    persist_buffer(archive, c_.device, photons_.flux_sums, flux_words * sizeof(std::int64_t));
}

std::string PhotonMapping::describe_pass() const {
    return progressive_ ? fmt::format("radius {:.3g}", image_.bandwidth.radii.indirect) : "";
}

void PhotonMapping::report(RenderStatistics& statistics) const {
    if (tracing_) {
        tracing_->report(statistics);
    }
    statistics.photons_emitted = image_.photons_emitted;
    statistics.photons_stored = image_.photons_stored;
    statistics.photons_in_view = image_.in_view * static_cast<double>(image_.photons_emitted);
    report_bandwidth(image_.bandwidth, statistics);
    statistics.mean_footprints = image_.mean_footprints;
    statistics.leaf_size = image_.leaf_size;
    statistics.footprint_scale = image_.footprint_scale;
    const SceneRecord& scene = c_.on_device.record;
    statistics.least_coverage = image_.untaken.value_or(Untaken{}).least_coverage;
    statistics.near_field = scene.follows_near != 0 ? scene.near_distance : 0;
    if (image_.maps > 0) {
        // Every pass emits all of the lights' power.
        statistics.flux = flux_of(download<std::int64_t>(c_.device, photons_.flux_sums, flux_words),
                                  image_.flux_unit / static_cast<double>(image_.maps));
    }
}

} // namespace

std::unique_ptr<Method> make_photon_mapping(RenderContext& context,
                                            std::unique_ptr<EstimationStrategy> strategy,
                                            bool progressive,
                                            std::unique_ptr<TracingStrategy> tracing) {
    return std::make_unique<PhotonMapping>(context, std::move(strategy),
                                           progressive || context.settings.progressive.on,
                                           std::move(tracing));
}

} // namespace argand
