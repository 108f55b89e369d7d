#include "methods/bandwidth.hpp"

#include "methods/view_extent.hpp"
#include "photon/radius.hpp"
#include "photon/smoothing.hpp"
#include "shared/footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argand {

namespace {

// Bounds of the semi-axes of caustic photons' footprints, over the radius that would serve for all
// caustics. Where a caustic folds, the linear map of the differentials holds only in a small
// neighbourhood: footprints shrink to lines and points there, which are seen as streaks and
// fireflies.
constexpr float least_caustic = 0.2f;
constexpr float most_caustic = 8;
// Bound of diffuse footprints over the radius that would serve for all. The few larger ones cost
// more time than they save noise, because their boxes overlap with many queries.
constexpr double largest_footprint = 1.4;
// Least radius over the scene's. Smaller ones are below the rounding of positions, and their
// squares underflow.
constexpr double least_radius = 1e-7;
// Number of photons for which a user's smoothing is meant.
constexpr double reference_photons = 200'000;

// Footprints that should contain a point over photons that a disc should hold. Footprints differ in
// size, and so do their weights.
constexpr double footprints_for_disc = 1.7;
// Least radius of caustics over that of all other light, unless most_over_median times the median
// is smaller. Caustics whose radius would be twice this or more get no radius of their own.
constexpr double sharpest_caustic = 0.17;
// Most of a caustic's photons lie where it is brightest. With the median radius the few elsewhere
// would be seen one by one.
constexpr double most_over_median = 2.4;

/// Largest radius at which an estimate still tells one part of what is in view from another. Where
/// few photons arrive, the learnt radius would reach through the walls.
double largest_radius(std::span<const glm::vec4> queries) {
    constexpr double share_of_view = 0.25;
    const double extent = view_extent(queries).distance;
    // All queries are at one point: nothing is known about the extent of what is in view.
    return extent > 0 ? share_of_view * extent : std::numeric_limits<double>::infinity();
}

/// Photons that a disc of one pass should hold.
double in_disc(const FirstPass& first, std::uint64_t photons, bool caustic, double evenness,
               std::optional<std::uint32_t> neighbours) {
    return neighbours
               ? *neighbours
               : in_disc_of_pass(static_cast<double>(photons), first.passes, caustic) / evenness;
}

/// The radius in which discs at the query points hold enough of these photons.
double radius_at_queries(const FirstPass& first, const SortedPhotons& photons, double evenness,
                         std::optional<std::uint32_t> neighbours) {
    const double wanted = in_disc(first, std::uint64_t(photons.others) + photons.caustics, false,
                                  evenness, neighbours);
    const double learnt = median_radius(first.device, photons, first.queries, wanted);
    // Without photons, or with all of them at one point, there is nothing to learn from.
    const double unlearnt = 0.01 * first.scene.record.radius;
    if (!(learnt > 0)) {
        return unlearnt;
    }
    const double largest = largest_radius(first.queries);
    if (learnt <= largest) {
        return learnt;
    }
    // A close-up of a small part of a room: discs of that size would hold hardly a photon.
    constexpr double least_share = 0.1;
    const double few = median_radius(first.device, photons, first.queries, least_share * wanted);
    // On a lit surface a tenth of the photons lies within a third of the radius. Where it does not,
    // all photons are in one place elsewhere, such as a closed lamp, from which they must not leak.
    // (A caustic is such a place, too, but may be in view.)
    constexpr double least_growth = 1.1;
    if (photons.caustics == 0 && learnt < least_growth * few) {
        return std::min(largest, unlearnt);
    }
    return std::max(largest, few);
}

/// The radii for a picture. That of caustics is measured where caustic photons lie.
GatherRadii radii_from(const FirstPass& first, std::optional<std::uint32_t> neighbours,
                       std::optional<std::uint32_t> caustic_neighbours) {
    const SortedPhotons& photons = first.photons;
    const Evenness& evenness = first.evenness;
    const double of_all = radius_at_queries(first, photons, evenness.all, neighbours);
    const double of_caustics = median_caustic_radius(
        first.device, photons,
        in_disc(first, photons.caustics, true, evenness.caustics, caustic_neighbours));
    // A single caustic photon, or all of them in one point, tell nothing. A radius that is little
    // smaller than the other gains nothing, and loses the boundary correction.
    const bool is_learnt = of_caustics > least_radius * first.scene.record.radius;
    if (!(is_learnt && of_caustics < 2 * sharpest_caustic * of_all)) {
        return {of_all, of_all};
    }
    // Discs that are large because other photons differ in flux must not blur the caustics.
    const double of_even =
        evenness.all < 1 ? radius_at_queries(first, photons, 1, neighbours) : of_all;
    SortedPhotons others = photons;
    others.caustics = 0;
    const double of_others = radius_at_queries(first, others, evenness.others, neighbours);
    return {of_others, std::min(std::clamp(sharpest_caustic * of_even, of_caustics,
                                           most_over_median * of_caustics),
                                of_others)};
}

FootprintScale scale_of(const FootprintSettings& settings, double photons, double smoothing,
                        double caustic_smoothing, double largest, const SceneRecord& scene) {
    FootprintScale scale = make_footprint_scale(
        static_cast<float>(photons), static_cast<float>(reference_photons), scene.radius,
        {.smoothing = static_cast<float>(smoothing),
         .caustic_smoothing = static_cast<float>(caustic_smoothing),
         .largest = static_cast<float>(largest),
         .flatness = static_cast<float>(settings.flatness),
         .exponent = settings.fixed_smoothing ? 0.5f : 1.0f / 6.0f});
    scale.principal_axes = settings.paper_axes ? 0 : 1;
    return scale;
}

/// Factor by which sizes fall with the number of passes, as they do with that of photons. A fixed
/// smoothing does not fall.
double shrinking(double passes) { return std::pow(passes, -1.0 / 6); }

/// k times `by`, but at least `least`, unless k is less itself.
std::uint32_t scaled_neighbours(std::uint32_t k, double by, double least) {
    return static_cast<std::uint32_t>(std::max(std::round(k * by), std::min<double>(least, k)));
}

// The k at which widths that fall from pass to pass stop to lower k: fewer photons hardly estimate
// a density.
constexpr std::uint32_t least_narrowed = 8;

} // namespace

void report_bandwidth(const Bandwidth& bandwidth, RenderStatistics& statistics) {
    statistics.radius = bandwidth.radii.indirect;
    statistics.caustic_radius = bandwidth.radii.caustic;
    statistics.neighbours = bandwidth.neighbours;
    statistics.caustic_neighbours = bandwidth.caustic_neighbours;
    statistics.smoothing = bandwidth.smoothing;
}

void persist_bandwidth(Archive& archive, Bandwidth& bandwidth) {
    archive.value(bandwidth.radii);
    archive.value(bandwidth.neighbours);
    archive.value(bandwidth.caustic_neighbours);
    archive.value(bandwidth.smoothing);
    archive.value(bandwidth.caustic_smoothing);
    archive.flag(bandwidth.caustics);
}

double in_disc_of_pass(double photons, double passes, bool caustic) {
    return photons_in_disc(photons * passes, caustic) / passes;
}

Bandwidth learn_radii(const FirstPass& first, const RenderSettings& settings,
                      std::optional<std::uint32_t> neighbours,
                      std::optional<std::uint32_t> caustic_neighbours) {
    Bandwidth b;
    b.caustics = first.photons.caustics > 0;
    const double radius = first.scene.record.radius;
    const double given = std::max(settings.radius.value_or(0), least_radius * radius);
    b.radii = settings.radius ? GatherRadii{given, given}
                              : radii_from(first, neighbours, caustic_neighbours);
    return b;
}

void learn_smoothing(Bandwidth& b, const FirstPass& first, const FootprintSettings& settings) {
    const double by = settings.fixed_smoothing ? 1 : shrinking(first.passes);
    b.caustic_smoothing = settings.caustic_smoothing * by;
    if (settings.smoothing) {
        b.smoothing = *settings.smoothing * by;
        return;
    }
    SortedPhotons photons = first.photons;
    add_footprints(first.device, first.workspace,
                   scale_of(settings, static_cast<double>(first.stored.emitted), 1, 1, 1e6,
                            first.scene.record),
                   photons);
    const double on_point =
        footprints_for_disc *
        in_disc_of_pass(static_cast<double>(first.stored.photons), first.passes) /
        first.evenness.others;
    const double learnt = median_smoothing(first.device, photons, first.queries, on_point);
    b.smoothing = learnt > 0 ? learnt : 1;
}

double photon_growth(const Bandwidth& learnt, double so_far, double exponent) {
    const std::uint32_t k = std::max(learnt.neighbours, learnt.caustic_neighbours);
    if (k == 0) {
        return 1;
    }
    const double least = std::min(least_narrowed, k);
    // x with k x (so_far + x)^(-2a) = least, approached from below.
    constexpr int most_steps = 1000;
    double photons = 1, before = 0;
    for (int i = 0; i < most_steps && photons > before; ++i) {
        before = photons;
        photons = std::max(before, least / k * std::pow(so_far + before, 2 * exponent));
    }
    return photons;
}

Bandwidth narrowed(const Bandwidth& learnt, double by, double photons, double scene_radius) {
    Bandwidth b = learnt;
    b.radii.indirect = std::max(by * b.radii.indirect, least_radius * scene_radius);
    b.radii.caustic = std::max(by * b.radii.caustic, least_radius * scene_radius);
    b.neighbours = scaled_neighbours(b.neighbours, by * by * photons, least_narrowed);
    b.caustic_neighbours =
        scaled_neighbours(b.caustic_neighbours, by * by * photons, least_narrowed);
    b.smoothing *= by;
    b.caustic_smoothing *= by;
    return b;
}

Bandwidth for_passes(const Bandwidth& learnt, double learnt_for, double passes,
                     const RenderSettings& settings) {
    const double by = shrinking(passes / learnt_for);
    Bandwidth b = learnt;
    // The photons that a disc should hold fix its radius.
    if (!settings.radius && !settings.neighbours) {
        b.radii.indirect *= by;
    }
    const bool fixes_caustic = b.caustic_neighbours > 0 ? settings.caustic_neighbours.has_value()
                                                        : settings.neighbours.has_value();
    if (!settings.radius && !fixes_caustic) {
        b.radii.caustic *= by;
    }
    constexpr double least_neighbours = 2;
    if (!settings.neighbours) {
        b.neighbours = scaled_neighbours(b.neighbours, by * by, least_neighbours);
    }
    if (!settings.caustic_neighbours) {
        b.caustic_neighbours = scaled_neighbours(b.caustic_neighbours, by * by, least_neighbours);
    }
    if (!settings.footprints.fixed_smoothing) {
        b.smoothing *= by;
        b.caustic_smoothing *= by;
    }
    return b;
}

FootprintScale footprint_scale(const Bandwidth& bandwidth, const FootprintSettings& settings,
                               double photons, const SceneRecord& scene) {
    const double largest =
        settings.largest.value_or(largest_footprint * bandwidth.radii.indirect / scene.radius);
    FootprintScale scale = scale_of(settings, photons, bandwidth.smoothing,
                                    bandwidth.caustic_smoothing, largest, scene);
    const auto caustic = static_cast<float>(
        std::min(bandwidth.radii.caustic, 4 * sharpest_caustic * bandwidth.radii.indirect));
    scale.caustic_min = std::max(scale.radius_min, least_caustic * caustic);
    // Beyond the bound of diffuse light, noise falls little and the cost of queries rises much.
    scale.caustic_max =
        std::max(scale.caustic_min, std::min(most_caustic * caustic, scale.radius_max));
    return scale;
}

} // namespace argand
