#include "base/median.hpp"
#include "bench.hpp"
#include "fd09.hpp"
#include "fd09_map.hpp"
#include "photon/vvh.hpp"

#include <algorithm>
#include <span>

namespace argand {

namespace {

constexpr std::uint32_t leaf_sizes[] = {1, 2, 4, 8, 16, 32, 64, 128, 256, 512};

struct Candidate {
    PhotonMap map;
    std::vector<double> seconds; ///< of each run, over all queries of the image
};

/// Times every candidate's estimates at the same queries. Runs are interleaved so that other load
/// on the machine affects all candidates alike.
class CandidateTimes final : public PhotonEstimator {
public:
    CandidateTimes(Device& device, const DeviceScene& scene, std::span<Candidate> candidates,
                   int runs)
        : device_(device), estimator_(device, scene.plan), candidates_(candidates), runs_(runs) {
        for (Candidate& candidate : candidates_) {
            candidate.seconds.assign(static_cast<std::size_t>(runs), 0.0);
        }
    }

    void estimate(const PhotonMap&, const PhotonQueries& queries) override {
        const std::uint32_t count =
            download_word(device_, queries.count.buffer, queries.count.index);
        queries_ += count;
        if (count == 0) {
            return;
        }
        for (int run = -1; run < runs_; ++run) { // one to warm up
            for (Candidate& candidate : candidates_) {
                const double seconds =
                    seconds_of(device_, [&] { estimator_.estimate(candidate.map, queries); });
                if (run >= 0) {
                    candidate.seconds[static_cast<std::size_t>(run)] += seconds;
                }
            }
        }
    }

    std::uint64_t queries() const { return queries_; }

private:
    Device& device_;
    FootprintEstimator estimator_;
    std::span<Candidate> candidates_;
    int runs_;
    std::uint64_t queries_ = 0;
};

/// The time that every candidate takes for all queries of the image. Returns their number.
std::uint64_t gather_with_each(Device& device, PaperMap& paper, std::vector<Candidate>& candidates,
                               int runs) {
    // Resume queries until complete, even if some take more steps than one dispatch allows.
    paper.eye.traversal.careful = true;
    CandidateTimes times(device, paper.scene, candidates, runs);
    const PhotonLookup lookup{.map = candidates.front().map, .estimator = times};
    trace_eye_paths(device, paper.scene, paper.eye, paper.eye_pass(1), &lookup,
                    [](double) { return true; });
    return times.queries();
}

/// Rates over leaf sizes, and how close T_auto, the last candidate, comes to the best.
nlohmann::ordered_json row_of(const std::string& scene, const PaperMap& paper,
                              std::span<const Candidate> candidates, std::uint64_t queries) {
    nlohmann::ordered_json row{
        {"scene", scene}, {"emitted", paper.render.photons}, {"hits", paper.stored.photons}};
    double best = 0;
    double automatic = 0;
    for (const Candidate& candidate : candidates) {
        automatic = 1e-3 * static_cast<double>(queries) / median(candidate.seconds);
        best = std::max(best, automatic);
        const bool last = &candidate == &candidates.back();
        row[last ? "T_auto's kqueries/s" : std::to_string(candidate.map.leaf_size)] = automatic;
    }
    row["T_auto"] = candidates.back().map.leaf_size;
    row["footprints a point"] = candidates.back().map.mean_footprints;
    row["T_auto of best [%]"] = 100 * automatic / best;
    return row;
}

} // namespace

void measure_trees(Device& device, const Scene& scene, const RenderSettings& render, int runs,
                   TreeTables& tables) {
    PaperMap paper = trace_paper_map(device, scene, render);
    const PhotonMap automatic = build(device, paper, 0);
    const std::vector<BoxRecord> boxes = footprint_boxes(device, automatic);

    std::vector<double> linear_seconds;
    std::vector<double> heuristic_seconds;
    VolumeTree tree;
    for (int run = 0; run < std::min(runs, 3); ++run) {
        linear_seconds.push_back(
            seconds_of(device, [&] { build(device, paper, automatic.leaf_size); }));
        heuristic_seconds.push_back(
            seconds_of(device, [&] { tree = build_volume_tree(boxes, automatic.leaf_size); }));
    }
    tree = build_volume_tree(boxes, 1);
    const PhotonMap sorted = reordered(device, automatic, tree.order);

    std::vector<Candidate> candidates;
    for (const std::uint32_t leaf_size : leaf_sizes) {
        candidates.push_back({build(device, paper, leaf_size), {}});
    }
    candidates.push_back({build(device, paper, automatic.leaf_size), {}});
    const std::size_t of_each = candidates.size();
    for (std::size_t i = 0; i < of_each; ++i) {
        candidates.push_back({with_tree(device, sorted, tree, candidates[i].map.leaf_size), {}});
    }
    const std::uint64_t queries = gather_with_each(device, paper, candidates, runs);

    const std::span<const Candidate> all(candidates);
    tables.linear.rows.push_back(row_of(scene.name, paper, all.first(of_each), queries));
    tables.heuristic.rows.push_back(row_of(scene.name, paper, all.last(of_each), queries));
    const char* const rate = "T_auto's kqueries/s";
    const double linear_rate = tables.linear.rows.back()[rate].get<double>();
    const double heuristic_rate = tables.heuristic.rows.back()[rate].get<double>();
    const double linear_built = median(linear_seconds);
    const double heuristic_built = median(heuristic_seconds);
    tables.builds.rows.push_back({{"scene", scene.name},
                                  {"in the map", boxes.size()},
                                  {"linear build [ms]", 1e3 * linear_built},
                                  {"VVH build [ms]", 1e3 * heuristic_built},
                                  {"VVH / linear, building", heuristic_built / linear_built},
                                  {"linear / VVH, rate [%]", 100 * linear_rate / heuristic_rate}});
}

} // namespace argand
