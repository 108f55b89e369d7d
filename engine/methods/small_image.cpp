#include "methods/small_image.hpp"

#include "methods/lens.hpp"
#include "shared/photon.h"
#include "shared/random.h"

#include <algorithm>
#include <utility>

namespace argand {

namespace {

/// The slots of the queries that an estimator answers.
std::vector<std::uint32_t> answered_slots(Device& device, const PhotonQueries& queries) {
    const std::uint32_t count = download_word(device, queries.count.buffer, queries.count.index);
    return download<std::uint32_t>(device, queries.slots, count);
}

/// Collects query points instead of estimating radiance at them: all estimates are 0.
class QueryCollector final : public PhotonEstimator {
public:
    QueryCollector(Device& device, std::size_t slots) : device_(device), slots_(slots) {}

    void estimate(const PhotonMap&, const PhotonQueries& queries) override {
        device_.fill(queries.estimates, 0); // paths go on or end as their answers tell
        const auto records = download<QueryRecord>(device_, queries.points, slots_);
        for (const std::uint32_t slot : answered_slots(device_, queries)) {
            const QueryRecord& record = records[slot];
            if ((record.flags & query_caustics) == 0) {
                const std::uint32_t normal =
                    pack_photon_normal(unpack_unit(record.geometric_normal), false);
                points.push_back({record.x, record.y, record.z, normal, {}});
            }
        }
    }

    std::vector<ViewPointRecord> points;

private:
    Device& device_;
    std::size_t slots_;
};

/// Counts answers, and those that are not to be taken.
class AnswerProbe final : public PhotonEstimator {
public:
    AnswerProbe(Device& device, std::size_t slots, double least_coverage,
                PhotonEstimator& estimator)
        : device_(device), slots_(slots), least_coverage_(least_coverage), estimator_(estimator) {}

    void estimate(const PhotonMap& map, const PhotonQueries& queries) override {
        estimator_.estimate(map, queries);
        if (queries.part == map_caustic) {
            return;
        }
        const auto records = download<QueryRecord>(device_, queries.points, slots_);
        const auto estimates = download<EstimateRecord>(device_, queries.estimates, slots_);
        for (const std::uint32_t slot : answered_slots(device_, queries)) {
            if ((records[slot].flags & query_caustics) == 0) {
                const EstimateRecord& e = estimates[slot];
                const bool lacks = e.coverage < least_coverage_;
                ++answers;
                strongly += lacks || e.uneven > Untaken::strongly_uneven ? 1 : 0;
                mildly += lacks || e.uneven > Untaken::mildly_uneven ? 1 : 0;
            }
        }
    }

    /// Answers, and those that lack the least coverage or are uneven.
    std::uint64_t answers = 0, strongly = 0, mildly = 0;

private:
    Device& device_;
    std::size_t slots_;
    double least_coverage_;
    PhotonEstimator& estimator_;
};

/// One sample for each pixel of a small version of the image, with as many pixels as there are
/// slots: a part of a larger one would be its top only.
EyeBatch batch_of_small_image(const EyeWorkspace& w, const RenderSettings& settings,
                              int longer_side) {
    const int longer = std::max(settings.width, settings.height);
    EyeBatch batch{};
    batch.seed = settings.seed;
    const auto pixels_along = [&](int side) {
        const std::int64_t pixels = std::int64_t(side) * longer_side / longer;
        return static_cast<std::uint32_t>(std::max<std::int64_t>(pixels, 1));
    };
    do {
        batch.width = pixels_along(settings.width);
        batch.height = pixels_along(settings.height);
        batch.pixels = batch.width * batch.height;
    } while (batch.pixels > w.slots && --longer_side > 0);
    batch.crop_width = batch.width; // all of it
    batch.samples = 1;
    batch.bounces = settings.bounces;
    batch.query_step = 1;
    batch.query_weight = 1;
    return batch;
}

/// The camera of a small version of the image, with the image's lens.
Buffer camera_of(Device& device, const EyeBatch& batch, const Camera& camera,
                 const CameraRecord& of_image) {
    CameraRecord record =
        camera_record(camera, static_cast<int>(batch.width), static_cast<int>(batch.height));
    copy_lens(of_image, record);
    return upload<CameraRecord>(device, "camera", std::span(&record, 1));
}

std::vector<ViewPointRecord> collect_queries(Device& device, const DeviceScene& scene,
                                             EyeWorkspace& w, const RenderSettings& settings,
                                             const Camera& camera, int longer_side) {
    const EyeBatch batch = batch_of_small_image(w, settings, longer_side);
    const Buffer small_image = camera_of(device, batch, camera, w.queries.view);
    const QuerySharing sharing = std::exchange(w.queries.sharing, {});
    QueryCollector collector(device, batch.pixels);
    const PhotonMap no_map;
    const PhotonLookup lookup{.map = no_map, .estimator = collector};
    trace_paths(device, scene, w, small_image, batch, &lookup);
    w.queries.sharing = sharing;
    return std::move(collector.points);
}

} // namespace

std::vector<glm::vec4> sample_queries(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                                      const RenderSettings& settings, const Camera& camera) {
    std::vector<glm::vec4> points;
    for (const ViewPointRecord& p : collect_queries(device, scene, w, settings, camera, 48)) {
        points.emplace_back(p.x, p.y, p.z, 0);
    }
    return points;
}

ViewPoints sample_view_points(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                              const RenderSettings& settings, const Camera& camera, double radius) {
    return make_view_points(device, collect_queries(device, scene, w, settings, camera, 96),
                            radius);
}

Untaken learn_untaken(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                      const RenderSettings& settings, const Camera& camera,
                      const PhotonLookup& lookup) {
    constexpr double small_share = 0.005, large_share = 0.02;
    const double least_coverage = least_coverage_of(settings);
    if (!(least_coverage > 0) || !scene.plan.needs(Feature::direct_light)) {
        return {};
    }
    EyeBatch batch = batch_of_small_image(w, settings, 48);
    // Other paths than the image's own, whose estimates it decides about.
    batch.seed = pcg4d({settings.seed, 0x07a4eu, 0, 0}).x;
    const Buffer small_image = camera_of(device, batch, camera, w.queries.view);
    const double cell = std::exchange(w.queries.sharing.cell, 0.0);
    const bool careful = std::exchange(w.traversal.careful, true);
    AnswerProbe probe(device, batch.pixels, least_coverage,
                      w.queries.final_gather ? lookup.gathering_estimator() : lookup.estimator);
    const PhotonLookup probed{.map = lookup.map, .estimator = probe};
    trace_paths(device, scene, w, small_image, batch, &probed);
    w.queries.sharing.cell = cell;
    w.traversal.careful = careful;
    const auto answers = static_cast<double>(probe.answers);
    if (static_cast<double>(probe.mildly) > large_share * answers) {
        return {untaken_often, Untaken::mildly_uneven, least_coverage};
    }
    const bool often = static_cast<double>(probe.strongly) > small_share * answers;
    return {often ? untaken_often : untaken_seldom, Untaken::strongly_uneven, least_coverage};
}

std::vector<FoundLight> sample_lights(Device& device, const DeviceScene& scene, EyeWorkspace& w,
                                      const RenderSettings& settings, const Camera& camera,
                                      std::uint32_t round) {
    constexpr std::uint64_t least_paths = 1024, most_paths = 16384;
    const std::vector<LightRecord>& lights = scene.light_table.lights;
    // Where photons start and in which directions is more to learn than how to choose lights.
    const bool aims =
        scene.plan.needs_photons() && std::any_of(lights.begin(), lights.end(), is_from_outside);
    const std::uint64_t share_of_image = aims ? 4 : 16;
    EyeBatch batch = batch_of_small_image(w, settings, 32);
    // These paths must not be the image's own: a choice that depends on them would bias it.
    batch.seed = pcg4d({settings.seed, 0x11947u, round, 0}).x;
    const std::uint64_t paths = std::clamp(
        pixels_of_image(settings) * settings.samples / share_of_image, least_paths, most_paths);
    batch.samples = static_cast<std::uint32_t>(
        std::max<std::uint64_t>(std::min(paths, w.slots) / batch.pixels, 1));
    const Buffer small_image = camera_of(device, batch, camera, w.queries.view);
    std::vector<FoundLight> found;
    trace_paths(device, scene, w, small_image, batch, nullptr, &found);
    return found;
}

} // namespace argand
