#include "methods/photon_mapping.hpp"

#include "base/error.hpp"
#include "base/median.hpp"
#include "methods/bandwidth.hpp"
#include "methods/photon_targets.hpp"
#include "photon/photon_map.hpp"
#include "photon/radius.hpp"
#include "shared/photon.h"
#include "shared/random.h"

#include <algorithm>

namespace argand {

namespace {

// Units of the fixed-point flux sums in the mean flux of a photon.
constexpr double units_per_photon = 1 << 18;

/// How photons and samples are spread over passes. All passes count the same, so they are of one
/// size: the noise of a small last one would be the noise of the image. Each pass has at least one
/// sample, so the image has more samples than the settings request if there are more passes than
/// that, or if samples do not divide evenly.
struct PassSplit {
    std::uint64_t passes = 1;
    std::uint64_t photons = 1; ///< of the largest pass
    std::uint32_t samples = 1; ///< of each pass, per pixel
};

PassSplit split(std::uint64_t photons, std::uint32_t samples, std::uint64_t most_photons) {
    PassSplit s;
    s.passes = std::max<std::uint64_t>((photons + most_photons - 1) / most_photons, 1);
    s.photons = std::max<std::uint64_t>((photons + s.passes - 1) / s.passes, 1);
    s.samples = static_cast<std::uint32_t>((samples + s.passes - 1) / s.passes);
    return s;
}

/// Seed of a pass's area samples, which differs for every seed and pass of an image.
std::uint32_t area_seed(const PassNumbers& numbers) {
    return pcg4d({numbers.seed, static_cast<std::uint32_t>(numbers.index), 0xa4ea5u, 0}).x;
}

void add_flux_sums(FluxSums& sums, const std::vector<std::int64_t>& words, double unit) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
        sums.emitted[channel] = words[channel];
        sums.absorbed[channel] = words[3 + channel];
        sums.escaped[channel] = words[6 + channel];
        sums.cut[channel] = words[9 + channel];
    }
    sums.unit = unit;
}

class PhotonMapping : public Method {
public:
    PhotonMapping(RenderContext& context, std::unique_ptr<EstimationStrategy> strategy)
        : c_(context), strategy_(std::move(strategy)) {
        // Without indirect light no photon is ever looked up.
        const bool indirect = c_.settings.bounces > 0 && c_.on_device.record.light_count > 0;
        emitted_ = indirect ? c_.settings.photons : 0;
    }

    void begin(Budget& budget) override {
        const std::vector<glm::vec4> queries = sample_queries(
            c_.device, c_.on_device, c_.eye, c_.settings, c_.scene.cameras[c_.settings.camera]);
        aim_at_casters(c_, queries);
        first_ = trace_first(budget);
        learnt_ = budget.once([&] {
            const SortedPhotons sorted = sort_photons(c_.device, photons_, *first_);
            const FirstPass first{.device = c_.device,
                                  .scene = c_.on_device,
                                  .workspace = photons_,
                                  .stored = *first_,
                                  .photons = sorted,
                                  .queries = queries,
                                  .passes = static_cast<double>(split_.passes)};
            const Bandwidth learnt = strategy_->learn(first, c_.settings);
            sample_areas_in_view(queries, strategy_->typical_radius(learnt));
            return learnt;
        });
    }

    std::uint64_t passes() const override { return split_.passes; }

    bool pass(const Pass& pass, const OnPart& on_part) override;

    bool has_numbers(std::uint64_t index) const override {
        // Photons have numbers of 32 bits, beyond which they would be the same again.
        const PhotonPass emission = emission_of({.index = index});
        return emission.first + emission.count <= 0xffffffffu &&
               has_sample_numbers(index, split_.samples);
    }

    void report(RenderStatistics& statistics) const override;

private:
    PhotonPass emission_of(const PassNumbers& numbers) const;
    void make_workspace();
    void sample_areas_in_view(const std::vector<glm::vec4>& queries, double radius);
    std::optional<StoredPhotons> trace(const PassNumbers& numbers);
    StoredPhotons stored_or_fail(const std::optional<StoredPhotons>& stored) const;
    StoredPhotons trace_first(Budget& budget);
    PhotonMap build_map(const PassNumbers& numbers);

    RenderContext& c_;
    std::unique_ptr<EstimationStrategy> strategy_;
    std::uint64_t emitted_ = 0; ///< photons of the whole image, as the settings request
    PassSplit split_;
    double flux_unit_ = 0; ///< of the fixed-point sums
    PhotonWorkspace photons_;
    std::optional<StoredPhotons> first_; ///< traced before the first pass, which uses them up
    Bandwidth learnt_;                   ///< for split_.passes passes
    // Of the last pass.
    StoredPhotons stored_;
    Bandwidth bandwidth_;
    std::optional<FootprintScale> footprint_scale_;
    double mean_footprints_ = 0;
    std::uint32_t leaf_size_ = 0;
    // Of all passes.
    std::uint64_t passes_done_ = 0, photons_emitted_ = 0, photons_stored_ = 0;
    FluxSums flux_;
};

/// The photons of a pass. If there are more passes than the settings request, their numbers
/// continue.
PhotonPass PhotonMapping::emission_of(const PassNumbers& numbers) const {
    const std::uint64_t round = numbers.index / split_.passes;
    const std::uint64_t in_round = numbers.index % split_.passes;
    const std::uint64_t first = emitted_ * in_round / split_.passes;
    return {.seed = numbers.seed,
            .first = round * emitted_ + first,
            .count = emitted_ * (in_round + 1) / split_.passes - first,
            .bounces = c_.settings.bounces};
}

void PhotonMapping::make_workspace() {
    photons_ = PhotonWorkspace(); // frees the old one's memory before the new one takes its own
    photons_ = make_photon_workspace(c_.device, split_.photons,
                                     c_.on_device.plan.needs(Feature::differentials));
    photons_.quasi_random = c_.settings.photon_sampling == Sampling::sobol;
    photons_.reemission = c_.settings.footprints.paper_reemission ? REEMIT_PAPER : REEMIT_COSINE;
    const auto& power = c_.on_device.light_table.power;
    flux_unit_ = std::max({power.r, power.g, power.b}) / static_cast<double>(split_.photons) /
                 units_per_photon;
}

std::optional<StoredPhotons> PhotonMapping::trace(const PassNumbers& numbers) {
    return trace_photons(c_.device, c_.on_device, photons_, emission_of(numbers),
                         static_cast<float>(flux_unit_));
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
/// as well.
StoredPhotons PhotonMapping::trace_first(Budget& budget) {
    split_ = split(emitted_, c_.settings.samples,
                   std::min(max_photons_per_pass(c_.device), c_.settings.photons_per_pass));
    for (;;) {
        make_workspace();
        budget.start_pass();
        const std::optional<StoredPhotons> stored = trace({.seed = c_.settings.seed});
        const bool has_room = stored && stored->slots <= max_stored_photons(c_.device) / 10 * 9;
        if (has_room || split_.photons == 1) {
            return stored_or_fail(stored);
        }
        split_ = split(emitted_, c_.settings.samples, split_.photons / 2);
    }
}

/// Samples areas only where most of what is in view lies, if the radius needs more samples than
/// there is room for on all surfaces: in a room on a large ground, in the room and before it.
void PhotonMapping::sample_areas_in_view(const std::vector<glm::vec4>& queries, double radius) {
    constexpr double reach = 4; // over the median distance of what is in view
    const DeviceScene& scene = c_.on_device;
    if (queries.empty() || has_room_for_area_samples(scene.surface_area, radius)) {
        return;
    }
    const glm::vec3 eye = c_.scene.cameras[c_.settings.camera].position;
    std::vector<double> distances;
    distances.reserve(queries.size());
    for (const glm::vec4& query : queries) {
        distances.push_back(glm::distance(glm::vec3(query), eye));
    }
    sample_areas(c_.device, c_.scene, c_.on_device, {eye, reach * median(std::move(distances))});
}

PhotonMap PhotonMapping::build_map(const PassNumbers& numbers) {
    footprint_scale_ =
        strategy_->footprints(bandwidth_, c_.settings.footprints,
                              static_cast<double>(split_.photons), c_.on_device.record);
    const double radius = strategy_->typical_radius(bandwidth_);
    PhotonMap map =
        build_photon_map(c_.device, c_.on_device, photons_, stored_,
                         {.area_samples = area_samples(c_.on_device.sampled_area, radius),
                          .cover_height = disc_half_height * radius,
                          .seed = area_seed(numbers),
                          .leaf_size = c_.settings.leaf_size,
                          .wide_codes = c_.settings.wide_codes,
                          .footprints = footprint_scale_});
    mean_footprints_ = map.mean_footprints;
    leaf_size_ = map.leaf_size;
    return map;
}

bool PhotonMapping::pass(const Pass& pass, const OnPart& on_part) {
    bandwidth_ =
        for_passes(learnt_, static_cast<double>(split_.passes), pass.expected, c_.settings);
    stored_ = first_ ? *first_ : stored_or_fail(trace(pass.numbers));
    first_.reset();
    const PhotonMap map = build_map(pass.numbers);
    c_.eye.queries.sharing = strategy_->sharing(
        bandwidth_, c_.settings.query_cell * strategy_->typical_radius(bandwidth_),
        c_.settings.query_cell > 0 || c_.settings.final_gather);
    const std::unique_ptr<PhotonEstimator> estimator = strategy_->make(c_, map, bandwidth_);
    const PhotonLookup lookup{.map = map, .estimator = *estimator};
    const EyePass eye{.seed = pass.numbers.seed,
                      .first_sample =
                          static_cast<std::uint32_t>(pass.numbers.index * split_.samples),
                      .samples = split_.samples,
                      .bounces = c_.settings.bounces};
    const bool finished = trace_eye_paths(c_.device, c_.on_device, c_.eye, eye, &lookup, on_part);
    ++passes_done_;
    photons_emitted_ += emission_of(pass.numbers).count;
    photons_stored_ += stored_.photons;
    // Every pass emits all of the lights' power.
    add_flux_sums(flux_, download<std::int64_t>(c_.device, photons_.flux_sums, 12),
                  flux_unit_ / static_cast<double>(passes_done_));
    return finished;
}

void PhotonMapping::report(RenderStatistics& statistics) const {
    statistics.photons_emitted = photons_emitted_;
    statistics.photons_stored = photons_stored_;
    statistics.radius = bandwidth_.radii.indirect;
    statistics.caustic_radius = bandwidth_.radii.caustic;
    statistics.neighbours = bandwidth_.neighbours;
    statistics.smoothing = bandwidth_.smoothing;
    statistics.mean_footprints = mean_footprints_;
    statistics.leaf_size = leaf_size_;
    statistics.footprint_scale = footprint_scale_;
    statistics.flux = flux_;
}

} // namespace

std::unique_ptr<Method> make_photon_mapping(RenderContext& context,
                                            std::unique_ptr<EstimationStrategy> strategy) {
    return std::make_unique<PhotonMapping>(context, std::move(strategy));
}

} // namespace argand
