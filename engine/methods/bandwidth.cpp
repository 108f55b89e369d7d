#include "methods/bandwidth.hpp"

#include "base/median.hpp"
#include "photon/radius.hpp"
#include "photon/smoothing.hpp"
#include "shared/footprint.h"
#include "shared/morton.h"
#include "shared/photon.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace argand {

namespace {

// Points at which the radius of caustics is measured, at least.
constexpr std::size_t caustic_samples = 1024;
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

struct Cube {
    glm::vec3 low, high;
};

Cube bounds_of(const SceneRecord& scene) {
    const glm::vec3 center(scene.center_x, scene.center_y, scene.center_z);
    return {center - scene.radius, center + scene.radius};
}

/// The photons without the empty slots, along the space-filling curve.
std::vector<PhotonRecord> in_curve_order(std::span<const PhotonRecord> photons,
                                         const Cube& bounds) {
    struct Place {
        std::uint32_t code, index;
    };
    std::vector<Place> places;
    for (std::uint32_t i = 0; i < photons.size(); ++i) {
        if (photons[i].normal != no_photon) {
            places.push_back(
                {morton30({photons[i].x, photons[i].y, photons[i].z}, bounds.low, bounds.high), i});
        }
    }
    std::sort(places.begin(), places.end(),
              [](const Place& a, const Place& b) { return a.code < b.code; });
    std::vector<PhotonRecord> ordered;
    ordered.reserve(places.size());
    for (const Place& place : places) {
        ordered.push_back(photons[place.index]);
    }
    return ordered;
}

// Footprints that should contain a point over photons that a disc should hold. Footprints differ in
// size, and so do their weights.
constexpr double footprints_for_disc = 1.7;
// Least radius of caustics over that of all other light. Caustics whose radius would be twice this
// or more get no radius of their own.
constexpr double sharpest_caustic = 0.17;

/// Largest radius at which an estimate still tells one part of what is in view from another. Where
/// few photons arrive, the learnt radius would reach through the walls.
double largest_radius(std::span<const glm::vec3> queries) {
    constexpr double share_of_view = 0.25;
    glm::dvec3 middle;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> places;
        places.reserve(queries.size());
        for (const glm::vec3& query : queries) {
            places.push_back(query[axis]);
        }
        middle[axis] = median(std::move(places));
    }
    std::vector<double> distances;
    distances.reserve(queries.size());
    for (const glm::vec3& query : queries) {
        distances.push_back(glm::length(glm::dvec3(query) - middle));
    }
    const double extent = median(std::move(distances));
    // All queries are at one point: nothing is known about the extent of what is in view.
    return extent > 0 ? share_of_view * extent : std::numeric_limits<double>::infinity();
}

/// The radii for a picture. That of caustics is measured where caustic photons lie, because that is
/// where caustics are.
GatherRadii radii_from(std::span<const PhotonRecord> unordered, std::span<const glm::vec3> queries,
                       const SceneRecord& scene, double passes,
                       std::optional<std::uint32_t> neighbours) {
    const Cube bounds = bounds_of(scene);
    const std::vector<PhotonRecord> photons = in_curve_order(unordered, bounds);
    std::vector<PhotonRecord> caustic;
    std::copy_if(photons.begin(), photons.end(), std::back_inserter(caustic),
                 [](const PhotonRecord& photon) { return photon_is_caustic(photon.normal); });
    const auto radius_of = [&](const std::vector<PhotonRecord>& some,
                               std::span<const glm::vec3> points, bool is_caustic) {
        const double in_disc =
            neighbours ? *neighbours
                       : in_disc_of_pass(static_cast<double>(some.size()), passes, is_caustic);
        return median_radius(some, points, bounds.low, bounds.high, in_disc);
    };
    std::vector<glm::vec3> in_caustics;
    for (std::size_t i = 0; i < caustic.size();
         i += std::max<std::size_t>(caustic.size() / caustic_samples, 1)) {
        in_caustics.emplace_back(caustic[i].x, caustic[i].y, caustic[i].z);
    }
    GatherRadii radii;
    // Without photons, or with all of them at one point, there is nothing to learn from.
    const double learnt = radius_of(photons, queries, false);
    radii.indirect = learnt > 0 ? std::min(learnt, largest_radius(queries)) : 0.01 * scene.radius;
    const double of_caustics = radius_of(caustic, in_caustics, true);
    // Most of a caustic's photons lie where it is brightest. With a smaller radius the few
    // elsewhere would be seen one by one. A radius that is little smaller than the other gains
    // nothing, and loses the boundary correction.
    const bool sharp = of_caustics > 0 && of_caustics < 2 * sharpest_caustic * radii.indirect;
    radii.caustic =
        sharp ? std::max(of_caustics, sharpest_caustic * radii.indirect) : radii.indirect;
    return radii;
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

std::vector<PhotonRecord> photons_of(const FirstPass& first) {
    return download<PhotonRecord>(first.device, first.workspace.photons, first.stored.slots);
}

} // namespace

double in_disc_of_pass(double photons, double passes, bool caustic) {
    return photons_in_disc(photons * passes, caustic) / passes;
}

Bandwidth learn_radii(const FirstPass& first, const RenderSettings& settings,
                      std::optional<std::uint32_t> neighbours) {
    const SceneRecord& scene = first.scene.record;
    const std::vector<PhotonRecord> photons = photons_of(first);
    Bandwidth b;
    b.caustics = std::any_of(photons.begin(), photons.end(), [](const PhotonRecord& photon) {
        return photon.normal != no_photon && photon_is_caustic(photon.normal);
    });
    const double given = std::max(settings.radius.value_or(0), least_radius * scene.radius);
    b.radii = settings.radius ? GatherRadii{given, given}
                              : radii_from(photons, first.queries, scene, first.passes, neighbours);
    return b;
}

void learn_smoothing(Bandwidth& b, const FirstPass& first, const FootprintSettings& settings) {
    const StoredPhotons& stored = first.stored;
    const double by = settings.fixed_smoothing ? 1 : shrinking(first.passes);
    b.caustic_smoothing = settings.caustic_smoothing * by;
    if (settings.smoothing) {
        b.smoothing = *settings.smoothing * by;
        return;
    }
    const auto offsets = download<glm::uvec4>(first.device, first.workspace.offsets, stored.slots);
    const double on_point =
        footprints_for_disc * in_disc_of_pass(static_cast<double>(stored.photons), first.passes);
    const FootprintScale unit =
        scale_of(settings, static_cast<double>(stored.emitted), 1, 1, 1e6, first.scene.record);
    const double learnt =
        median_smoothing(photons_of(first), offsets, first.queries, unit, on_point);
    b.smoothing = learnt > 0 ? learnt : 1;
}

Bandwidth for_passes(const Bandwidth& learnt, double learnt_for, double passes,
                     const RenderSettings& settings) {
    const double by = shrinking(passes / learnt_for);
    Bandwidth b = learnt;
    if (!settings.radius && !settings.neighbours) {
        b.radii.indirect *= by;
        b.radii.caustic *= by;
    }
    if (!settings.neighbours && b.neighbours > 0) {
        b.neighbours =
            static_cast<std::uint32_t>(std::max(std::round(b.neighbours * by * by), 2.0));
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
