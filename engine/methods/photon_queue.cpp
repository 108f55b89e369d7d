#include "photon/photon_queue.hpp"

#include "base/error.hpp"
#include "methods/bandwidth.hpp"
#include "methods/fixed_radius.hpp"
#include "methods/footprint_estimation.hpp"
#include "methods/light_change.hpp"
#include "methods/nearest_photons.hpp"
#include "methods/persist_buffer.hpp"
#include "methods/persist_queue.hpp"
#include "methods/photon_targets.hpp"
#include "methods/queue_ages.hpp"
#include "methods/queue_maps.hpp"
#include "methods/queue_photons.hpp"
#include "methods/render_options.hpp"
#include "methods/sample_parts.hpp"
#include "methods/show_photons.hpp"
#include "methods/traced_photons.hpp"
#include "methods/view_areas.hpp"
#include "photon/queue_paths.hpp"
#include "photon/radius.hpp"
#include "photon/triangle_planes.hpp"
#include "shared/photon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Light that changes by more from one frame to the next has all its photons traced anew.
constexpr double most_change = 0.5;
// Moved boxes reach so many radii of estimation farther.
constexpr double reach_of_moved = 1;

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

/// What belongs to one image.
struct QueueImage {
    std::uint64_t blocks = 0, emitted = 0, stored = 0; ///< traced for it
    double flux_unit = 0;
    double in_view = 0;                            ///< photons stored in view per photon emitted
    std::optional<FootprintScale> footprint_scale; ///< of the last pass
    double mean_footprints = 0;
    bool traced = false;                  ///< the photons of the next pass are in the queue already
    std::optional<std::uint32_t> untaken; ///< learn_untaken()
};

/// The photons queue (Shi 2012, chapter 3): each frame traces a block of photons, which takes the
/// place of the oldest one in a queue whose cells stay.
class QueueMethod : public Method {
public:
    explicit QueueMethod(RenderContext& context)
        : c_(context), options_(options_of(context.settings)),
          strategy_(make_strategy(options_.estimator)),
          photons_(context, options_, std::max<std::uint64_t>(context.settings.least_passes, 1)) {}

    void begin_frame(Budget& budget) override;
    std::uint64_t passes() const override { return maps() * parts().count; }
    bool pass(const Pass& pass, const OnProgress& on_part) override;
    bool is_settled() const override { return still_ >= options_.window; }
    std::uint64_t passes_per_seed() const override {
        return numbers_of_seed /
               std::max<std::uint64_t>({photons_.all(), samples_of_map(), std::uint64_t(1)}) *
               parts().count;
    }
    void persist(Archive& archive) override;
    void report(RenderStatistics& statistics) const override;

private:
    static QueueOptions options_of(const RenderSettings& settings);
    std::uint32_t leaf_size() const {
        constexpr std::uint32_t automatic = 16; // as that of photon_map.cpp
        return c_.settings.leaf_size > 0 ? c_.settings.leaf_size : automatic;
    }
    /// Maps of an image. Each frame of a film has one, but with an open shutter.
    std::uint64_t maps() const { return std::max<std::uint64_t>(c_.settings.least_passes, 1); }
    std::uint32_t samples_of_map() const {
        return static_cast<std::uint32_t>((c_.settings.samples + maps() - 1) / maps());
    }
    SampleParts parts() const {
        return options_.shows_photons ? SampleParts{}
                                      : divide_samples(c_.settings, c_.eye, samples_of_map());
    }
    PhotonQueue empty_queue() const;
    /// The block that was traced last.
    std::uint32_t newest() const { return (next_ + options_.window - 1) % options_.window; }
    double learn(const PassNumbers& numbers, std::span<const glm::vec4> queries);
    StoredPhotons trace(const PassNumbers& numbers, std::uint32_t block);
    void add(const PassNumbers& numbers, std::uint32_t block, const StoredPhotons& stored);
    void refill(const PassNumbers& numbers, std::span<const glm::vec4> queries, Budget* budget);
    void add_next(const PassNumbers& numbers);
    void divide_if_crowded();
    void update(const PassNumbers& numbers, std::span<const glm::vec4> queries, Budget* budget);
    double age();
    bool drop_crossed(const SceneChange& change);
    void add_areas(const PassNumbers& numbers, const StoredPhotons& stored);
    Bandwidth bandwidth() const;
    void size_areas(const FootprintScale& scale);
    PhotonMap make_map(const Bandwidth& widths);
    void make_lookup();
    bool trace_eyes(const EyePass& eye, const PhotonLookup& lookup, const OnProgress& on_part);
    const std::vector<CellNode>& planes();

    RenderContext& c_;
    QueueOptions options_;
    std::unique_ptr<EstimationStrategy> strategy_;
    QueuePhotons photons_;
    PhotonWorkspace workspace_; ///< for maps: with --rebuild, or with footprints

    std::optional<std::vector<CellNode>> planes_; ///< none: not known yet
    PhotonQueue queue_;
    QueueAges ages_;
    std::uint32_t moment_ = 0;          ///< of the last update, from 1; 0: there is no queue
    std::uint32_t next_ = 0;            ///< the block to trace next
    std::uint32_t emptied_ = 0;         ///< moment at which cells were emptied last
    MovedBoxes moved_;                  ///< of the moments since the oldest block
    std::vector<CrossedShare> crossed_; ///< of the block that was traced last
    std::uint32_t still_ = 0;           ///< blocks traced since anything changed
    SeenScene seen_;
    Bandwidth learnt_;
    double view_reach_ = 0;
    SampledPart sampled_;            ///< where the area samples lie
    bool areas_moved_ = true;        ///< they have to be sampled anew
    std::uint32_t sized_blocks_ = 0; ///< blocks of which photons made area samples' footprints
    QueueImage image_;
    std::unique_ptr<MadeMap> made_; ///< until all of its samples are traced
};

/// The moments of a shutter's passes do not follow one another: nothing is kept from pass to pass.
QueueOptions QueueMethod::options_of(const RenderSettings& settings) {
    QueueOptions options = queue_options_of(settings);
    if (settings.least_passes > 1) {
        options.window = 1;
    }
    return options;
}

PhotonQueue QueueMethod::empty_queue() const {
    PhotonQueue queue = make_photon_queue(options_.window, leaf_size(),
                                          options_.estimator == QueueEstimator::footprints);
    queue.leaves_test = options_.classify == QueueClassify::leaves;
    queue.lights = photons_.lights();
    queue.keeps_paths = photons_.keeps_paths();
    return queue;
}

/// Traces a block.
StoredPhotons QueueMethod::trace(const PassNumbers& numbers, std::uint32_t block) {
    const StoredPhotons stored =
        photons_.trace(numbers, photons_.all() * block / options_.window, photons_.of(block),
                       photons_.all(), image_.flux_unit);
    ++image_.blocks;
    image_.emitted += stored.emitted;
    image_.stored += stored.photons;
    return stored;
}

void QueueMethod::add(const PassNumbers& numbers, std::uint32_t block,
                      const StoredPhotons& stored) {
    if (areas_moved_) {
        add_areas(numbers, stored);
    }
    replace_block(c_.device, queue_, block, moment_,
                  {.photons = photons_.workspace().photons,
                   .slots = stored.slots,
                   .records = stored.photons,
                   .offsets = photons_.workspace().offsets,
                   .lights = photons_.workspace().lights,
                   .vertices = photons_.workspace().vertices,
                   .paths = stored.emitted});
    forget_moved_boxes(moved_, moment_ - std::min(moment_, options_.window));
    mark_crossed(c_.device, queue_, block, moved_);
    crossed_ = crossed_shares(c_.device, queue_, block, moved_);
    renew(ages_, block, stored.emitted);
    next_ = (block + 1) % options_.window;
    ++still_;
}

/// Samples the areas of surfaces, behind the photons that were traced last.
void QueueMethod::add_areas(const PassNumbers& numbers, const StoredPhotons& stored) {
    if (!strategy_->corrects_boundaries(c_.settings)) {
        areas_moved_ = false;
        return;
    }
    const double radius = strategy_->typical_radius(learnt_);
    sample_areas_in_view(c_, view_reach_, radius, 1);
    // Half of the room is left to photons, if they need it.
    const std::uint64_t room = max_stored_photons(c_.device);
    const std::uint64_t most = room - std::min(room / 2, 2 * options_.window * stored.photons);
    const std::uint64_t wanted = area_samples(c_.on_device.areas.area, radius, 1);
    const std::uint32_t samples =
        append_area_samples(c_.device, c_.on_device, photons_.workspace(), stored,
                            {.area_samples = std::min(wanted, most),
                             .cover_height = disc_half_height * radius,
                             .seed = area_seed(numbers)});
    sampled_ = c_.on_device.areas.part;
    replace_block(c_.device, queue_, options_.window, queue_always,
                  {.photons = photons_.workspace().photons,
                   .first = stored.slots,
                   .slots = samples,
                   .records = samples,
                   .offsets = photons_.workspace().offsets,
                   .lights = photons_.workspace().lights});
    sized_blocks_ = 0;
    areas_moved_ = samples == 0 && stored.photons == 0; // no photon: a later block may have some
}

const std::vector<CellNode>& QueueMethod::planes() {
    if (!planes_) {
        const double records = static_cast<double>(photons_.all());
        planes_ = options_.cells == QueueCells::photons
                      ? std::vector<CellNode>()
                      : triangle_planes(c_.scene, records / leaf_size());
    }
    return *planes_;
}

void QueueMethod::divide_if_crowded() {
    if (is_crowded(queue_) && emptied_ == 0) {
        divide_queue_anew(c_.device, queue_, planes());
    }
}

/// Learns the bandwidth of an image, and returns the photons in view for each that is emitted. A
/// block may have too few photons to learn from: as many as there is room for are traced.
double QueueMethod::learn(const PassNumbers& numbers, std::span<const glm::vec4> queries) {
    const std::uint64_t count = std::min(photons_.all(), photons_.room());
    const StoredPhotons stored = photons_.trace(numbers, 0, count, count, image_.flux_unit);
    const double whole = static_cast<double>(photons_.all()) /
                         static_cast<double>(std::max<std::uint64_t>(count, 1));
    const SortedPhotons sorted = sort_photons(c_.device, photons_.workspace(), stored);
    learnt_ = strategy_->learn({.device = c_.device,
                                .scene = c_.on_device,
                                .workspace = photons_.workspace(),
                                .stored = stored,
                                .photons = sorted,
                                .queries = queries,
                                .passes = whole * static_cast<double>(maps()),
                                .evenness = evenness_in_view(c_, photons_.workspace(), stored)},
                               c_.settings);
    learnt_ = for_all_photons(learnt_, whole, c_.settings);
    view_reach_ = reach_of_view(queries, c_.scene.cameras[c_.settings.camera]);
    const double in_view = in_view_per_emitted(c_, photons_.workspace(), stored, queries);
    c_.device.fill(photons_.workspace().flux_sums, 0); // these photons are traced again
    return in_view;
}

/// Empties the queue and fills it with photons of this moment: all blocks, or the first one only.
void QueueMethod::refill(const PassNumbers& numbers, std::span<const glm::vec4> queries,
                         Budget* budget) {
    photons_.make_room(); // photons may tell other lights apart than before
    queue_ = empty_queue();
    ages_ = make_ages(options_.window, queue_.lights);
    areas_moved_ = true;
    still_ = 0;
    emptied_ = 0;
    moved_ = {};
    if (budget) { // else a light has appeared within an image
        image_.in_view = budget->once([&] { return learn(numbers, queries); });
    }
    const StoredPhotons stored = trace(numbers, 0);
    const StoredPhotons both{.slots = stored.slots, .photons = stored.photons};
    divide_queue(c_.device, queue_, planes(),
                 {photons_.workspace().photons, 0, both.slots, both.photons}, options_.window,
                 c_.on_device.plan.needs(Feature::followed_paths));
    add(numbers, 0, stored);
    for (std::uint32_t block = 1; block < options_.window; ++block) {
        const bool has_photons = image_.emitted > 0;
        if (options_.fills || (!has_photons && photons_.all() > 0)) {
            add(numbers, block, trace(numbers, block));
        }
    }
    divide_if_crowded();
}

/// Adds the next block, in the place of the oldest one.
void QueueMethod::add_next(const PassNumbers& numbers) {
    add(numbers, next_, trace(numbers, next_));
    divide_if_crowded();
}

/// Drops the photons on whose paths meshes have moved, if that leaves any worth mentioning.
bool QueueMethod::drop_crossed(const SceneChange& change) {
    constexpr double most_dropped = 0.9;
    constexpr double rounding = 1e-5; // of places, over the scene's radius
    if (!queue_.keeps_paths) {
        return false;
    }
    MovedBoxes now;
    add_moved_boxes(now, change.moved, moment_, rounding * c_.on_device.record.radius);
    if (share_crossed(c_.device, queue_, newest(), now) > most_dropped) {
        return false;
    }
    mark_crossed(c_.device, queue_, every_block, now);
    moved_.boxes.insert(moved_.boxes.end(), now.boxes.begin(), now.boxes.end());
    moved_.moments.insert(moved_.moments.end(), now.moments.begin(), now.moments.end());
    return true;
}

/// Lets the photons in the queue grow older by what has changed since the last update, and drops
/// those that surfaces which have moved may change. Returns how much the light has changed.
double QueueMethod::age() {
    const SceneChange change = scene_change(seen_, c_.on_device);
    seen_ = seen_of(c_.on_device);
    double most = change.most();
    if (!(most > 0) && change.moved.empty()) {
        return 0;
    }
    still_ = 0;
    if (most > most_change) {
        return most;
    }
    areas_moved_ = areas_moved_ || !change.moved.empty();
    double of_all = change.of_all;
    if (!change.moved.empty() && !drop_crossed(change)) {
        emptied_ = moment_;
        empty_near(c_.device, queue_, change.moved,
                   reach_of_moved * strategy_->typical_radius(learnt_), moment_);
        of_all = std::max(of_all, change.by_meshes);
        most = std::max(most, change.by_meshes);
    }
    const double in_disc = photons_in_disc(static_cast<double>(queue_.entries));
    const std::vector<double> shares = photons_.light_shares();
    for (std::uint32_t light = 0; light < ages_.lights; ++light) {
        const double of_light = ages_.lights > 1 ? std::max(of_all, change.of_lights[light]) : most;
        if (of_light > 0) {
            const double half_life = options_.half_life.value_or(
                balanced_half_life(of_light, options_.window, in_disc * shares[light]));
            grow_older(ages_, light, 1 / half_life);
        }
    }
    return most;
}

/// Brings the queue to the scene as it is.
void QueueMethod::update(const PassNumbers& numbers, std::span<const glm::vec4> queries,
                         Budget* budget) {
    const bool begins = moment_ == 0;
    if (begins) {
        seen_ = seen_of(c_.on_device);
    }
    const double change = begins ? infinity : age();
    ++moment_;
    // Where no photon is left from before something moved, cells may be divided anew.
    if (emptied_ > 0 && moment_ > emptied_ + options_.window) {
        emptied_ = 0;
    }
    const bool moved_view =
        std::isfinite(sampled_.reach) && !begins &&
        glm::distance(sampled_.center, c_.scene.cameras[c_.settings.camera].position) >
            0.1 * sampled_.reach;
    areas_moved_ = areas_moved_ || moved_view;
    if (begins || change > most_change || (emptied_ > 0 && is_crowded(queue_))) {
        refill(numbers, queries, budget);
    } else {
        add_next(numbers);
    }
}

void QueueMethod::begin_frame(Budget& budget) {
    image_ = {};
    made_ = nullptr;
    photons_.make_room();
    c_.device.fill(photons_.workspace().flux_sums, 0);
    const auto& power = c_.on_device.light_table.power;
    const double most = std::max({power.r, power.g, power.b});
    image_.flux_unit = (most > 0 ? most : 1) /
                       static_cast<double>(std::max<std::uint64_t>(photons_.of(0), 1)) /
                       units_per_photon;
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
    // A disc at the edge of the sampled part would lack some of its samples.
    constexpr double inner_share = 0.9;
    const QueueMapSettings settings{
        .rebuild = options_.rebuild,
        .corrected = {sampled_.center, inner_share * sampled_.reach},
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
    made_->untaken = image_.untaken.value_or(untaken_never);
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

} // namespace

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
