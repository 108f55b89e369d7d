// What a photons queue holds: how it is filled, grows older and is brought up to date.
#include "methods/queue_method.hpp"
#include "methods/traced_photons.hpp"
#include "methods/view_areas.hpp"
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

} // namespace

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

} // namespace argand
