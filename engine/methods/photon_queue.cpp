// The picture that a photons queue gives of a frame; queue_update.cpp has what it holds.
#include "methods/fixed_radius.hpp"
#include "methods/footprint_estimation.hpp"
#include "methods/nearest_photons.hpp"
#include "methods/persist_buffer.hpp"
#include "methods/persist_queue.hpp"
#include "methods/photon_targets.hpp"
#include "methods/queue_method.hpp"
#include "methods/show_photons.hpp"
#include "methods/small_image.hpp"
#include "methods/traced_photons.hpp"
#include "photon/covered.hpp"

#include <algorithm>

namespace argand {

namespace {

std::unique_ptr<EstimationStrategy> make_strategy(QueueEstimator estimator) {
    switch (estimator) {
    case QueueEstimator::nearest:
        return make_nearest();
    case QueueEstimator::footprints:
        return make_footprints();
    default:
        return make_fixed_radius();
    }
}

} // namespace

QueueMethod::QueueMethod(RenderContext& context)
    : c_(context), options_(options_of(context.settings)),
      strategy_(make_strategy(options_.estimator)),
      photons_(context, options_, std::max<std::uint64_t>(context.settings.least_passes, 1)) {}

void QueueMethod::begin_frame(Budget& budget) {
    image_ = {};
    made_ = nullptr;
    photons_.make_room();
    c_.device.fill(photons_.workspace().flux_sums, 0);
    image_.flux_unit = flux_unit_for(c_.on_device, photons_.of(0));
    const std::vector<glm::vec4> queries = sample_queries(
        c_.device, c_.on_device, c_.eye, c_.settings, c_.scene.cameras[c_.settings.camera]);
    aim_at_casters(c_, queries);
    if (strategy_->takes_uneven_photons()) {
        aim_at_view(c_, queries);
    }
    budget.start_pass();
    update({.seed = c_.settings.seed, .index = 0}, queries, &budget);
    image_.traced = true;
}

/// The bandwidth for the photons in the queue as they count: uneven weights have the noise of fewer
/// photons, and each disc holds the more of them.
Bandwidth QueueMethod::bandwidth() const {
    constexpr double nearly_all = 0.999;
    const double all = static_cast<double>(photons_.all());
    const double even = effective_photons(queue_, ages_, photons_.light_shares(), crossed_);
    const double share = even > 0 && all > 0 ? even / all : 1;
    return share < nearly_all ? for_passes(learnt_, 1, share, c_.settings) : learnt_;
}

/// Makes the footprints of the area samples if there are new ones, or more blocks to make them by.
void QueueMethod::size_areas(const FootprintScale& scale) {
    const auto traced = static_cast<std::uint32_t>(
        std::count_if(queue_.blocks.begin(), queue_.blocks.end(),
                      [](const QueueBlock& block) { return block.moment > 0; }));
    if (traced > sized_blocks_) {
        size_area_footprints(c_.device, queue_, workspace_, {c_.on_device, scale});
        sized_blocks_ = traced;
    }
}

PhotonMap QueueMethod::make_map(const Bandwidth& widths) {
    const QueueMapSettings settings{
        .rebuild = options_.rebuild,
        .corrected = corrected_part(sampled_),
        .reach = strategy_->typical_radius(widths),
        .scale = strategy_->footprints(widths, c_.settings.footprints,
                                       static_cast<double>(photons_.all()), c_.on_device.record)};
    if (settings.scale) {
        size_areas(*settings.scale);
    }
    PhotonMap map = make_queue_map(c_, queue_, workspace_, settings);
    image_.footprint_scale = settings.scale;
    image_.mean_footprints = map.mean_footprints;
    return map;
}

/// Traces the eye paths of a pass. Where photons account for direct light, there are no shadow rays
/// and no rays that seek emitters.
bool QueueMethod::trace_eyes(const EyePass& eye, const PhotonLookup& lookup,
                             const OnProgress& on_part) {
    if (!options_.direct) {
        return trace_eye_paths(c_.device, c_.on_device, c_.eye, eye, &lookup, on_part);
    }
    DeviceScene without_rays = c_.on_device;
    without_rays.plan.required.erase(Feature::direct_light);
    return trace_eye_paths(c_.device, without_rays, c_.eye, eye, &lookup, on_part);
}

/// Readies the map of the queue for the eye paths of a pass.
void QueueMethod::make_lookup() {
    made_ = std::make_unique<MadeMap>();
    weigh_blocks(queue_, ages_);
    const Bandwidth widths = bandwidth();
    made_->map = make_map(widths);
    const double cell = c_.settings.query_cell * strategy_->typical_radius(widths);
    c_.eye.queries.sharing = {
        .cell = cell,
        .caustics_apart = strategy_->parts_caustics(widths, cell > 0 || c_.settings.final_gather),
        .sharp_caustics = has_sharp_caustics(widths)};
    made_->estimator = strategy_->make(c_, made_->map, widths);
    made_->gathers = strategy_->make_for_gathers(c_, widths);
    const bool seeks_emission = !options_.direct && !options_.shows_photons;
    if (!image_.untaken && seeks_emission && made_->map.area_samples > 0) {
        image_.untaken = learn_untaken(c_.device, c_.on_device, c_.eye, c_.settings,
                                       c_.scene.cameras[c_.settings.camera], made_->lookup());
    }
    made_->untaken = image_.untaken.value_or(Untaken{});
}

bool QueueMethod::pass(const Pass& pass, const OnProgress& on_part) {
    const SampleParts parts = this->parts();
    const std::uint64_t part = pass.numbers.index % parts.count;
    const PassNumbers numbers{pass.numbers.seed, pass.numbers.index / parts.count};
    if (part == 0 && !image_.traced) {
        update(numbers, {}, nullptr);
    }
    image_.traced = false;
    if (part == 0 || !made_) {
        make_lookup();
    }
    if (options_.shows_photons) {
        draw_photons(c_, made_->map);
        made_ = nullptr;
        return on_part(1);
    }
    const PhotonLookup lookup = made_->lookup();
    const EyePass eye{.seed = numbers.seed,
                      .first_sample = static_cast<std::uint32_t>(numbers.index * samples_of_map()),
                      .samples = samples_of_map(),
                      .bounces = c_.settings.bounces};
    const bool finished = trace_eyes(part_of(eye, parts, part), lookup, on_part);
    if (!finished || part + 1 == parts.count) {
        made_ = nullptr; // frees its memory before the next one takes its own
    }
    return finished;
}

void QueueMethod::persist(Archive& archive) {
    archive.value(image_.blocks);
    archive.value(image_.emitted);
    archive.value(image_.stored);
    archive.value(image_.flux_unit);
    archive.value(image_.in_view);
    archive.optional(image_.footprint_scale);
    archive.value(image_.mean_footprints);
    archive.flag(image_.traced);
    archive.optional(image_.untaken);
    persist_ages(archive, ages_);
    archive.value(moment_);
    archive.value(next_);
    archive.value(emptied_);
    archive.values(moved_.boxes);
    archive.values(moved_.moments);
    archive.value(still_);
    persist_bandwidth(archive, learnt_);
    archive.value(view_reach_);
    archive.value(sampled_);
    archive.flag(areas_moved_);
    archive.value(sized_blocks_);
    if (ages_.emitted.size() != options_.window || ages_.lights != photons_.lights() ||
        ages_.half_lives.size() != std::size_t(options_.window) * ages_.lights ||
        moved_.boxes.size() != moved_.moments.size() ||
        !std::is_sorted(moved_.moments.begin(), moved_.moments.end()) || next_ >= options_.window ||
        moment_ == 0) {
        fail("loading a saved state: it is not one of a photons queue of {} blocks",
             options_.window);
    }
    if (archive.loads()) {
        made_ = nullptr;
        photons_.make_room();
        queue_ = empty_queue();
        seen_ = seen_of(c_.on_device);
    }
    persist_queue(archive, c_.device, queue_);
    crossed_ = crossed_shares(c_.device, queue_, newest(), moved_);
    persist_buffer(archive, c_.device, photons_.workspace().flux_sums,
                   flux_words * sizeof(std::int64_t));
}

void QueueMethod::report(RenderStatistics& statistics) const {
    statistics.photons_emitted = image_.emitted;
    statistics.photons_stored = image_.stored;
    statistics.photons_in_view = image_.in_view * static_cast<double>(image_.emitted);
    report_bandwidth(bandwidth(), statistics);
    statistics.least_coverage = image_.untaken.value_or(Untaken{}).least_coverage;
    statistics.leaf_size = queue_.leaf_size;
    statistics.footprint_scale = image_.footprint_scale;
    statistics.mean_footprints = image_.mean_footprints;
    if (image_.blocks > 0) {
        // Every block emits all of the lights' power.
        statistics.flux =
            flux_of(download<std::int64_t>(c_.device, photons_.workspace().flux_sums, flux_words),
                    image_.flux_unit / static_cast<double>(image_.blocks));
    }
}

MethodInfo photon_queue_method() {
    return {.name = "photon-queue",
            .summary = "photon mapping, photons kept from frame to frame of a film",
            .paper = "Shi 2012",
            .abilities = {.photon_map = true, .keeps_photons = true},
            .law = photon_mapping_law,
            .options = all_queue_options(),
            .make = [](RenderContext& context) -> std::unique_ptr<Method> {
                return std::make_unique<QueueMethod>(context);
            },
            .wants_footprints =
                [](const RenderSettings& settings) {
                    return queue_options_of(settings).estimator == QueueEstimator::footprints;
                }};
}

} // namespace argand
