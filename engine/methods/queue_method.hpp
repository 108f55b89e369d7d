#pragma once

#include "methods/bandwidth.hpp"
#include "methods/estimation_strategy.hpp"
#include "methods/light_change.hpp"
#include "methods/method.hpp"
#include "methods/queue_ages.hpp"
#include "methods/queue_maps.hpp"
#include "methods/queue_options.hpp"
#include "methods/queue_photons.hpp"
#include "methods/sample_parts.hpp"
#include "methods/view_areas.hpp"
#include "photon/photon_queue.hpp"
#include "photon/queue_paths.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace argand {

/// What belongs to one image.
struct QueueImage {
    std::uint64_t blocks = 0, emitted = 0, stored = 0; ///< traced for it
    double flux_unit = 0;
    double in_view = 0;                            ///< photons stored in view per photon emitted
    std::optional<FootprintScale> footprint_scale; ///< of the last pass
    double mean_footprints = 0;
    bool traced = false;            ///< the photons of the next pass are in the queue already
    std::optional<Untaken> untaken; ///< learn_untaken()
};

/// The photons queue (Shi 2012, chapter 3): each frame traces a block of photons, which takes the
/// place of the oldest one in a queue whose cells stay.
class QueueMethod : public Method {
public:
    explicit QueueMethod(RenderContext& context);

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

} // namespace argand
