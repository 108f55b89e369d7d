#include "methods/queue_options.hpp"

#include "base/error.hpp"
#include "methods/fixed_radius.hpp"
#include "methods/footprint_estimation.hpp"
#include "methods/nearest_photons.hpp"
#include "methods/render_options.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace argand {

namespace {

// An entry of the queue names its block in 8 bits.
constexpr double most_window = 128;

Option window_option() {
    Option option = own_option("window",
                               "Frames in which all photons of the queue are replaced: each traces "
                               "--photons divided by this number",
                               OptionKind::integer, "10");
    option.low = 1;
    option.high = most_window;
    return option;
}

Option half_life_option() {
    Option option = own_option(
        "half-life",
        "Frames after which photons count half while lights or surfaces move (default: by the "
        "motion)",
        OptionKind::number, "auto");
    option.low = 1e-3;
    option.high = 1e9;
    return option;
}

Option fill_option() {
    return own_choice_option(
        "queue-fill",
        "Photons of the first frame, and of frames in which lights appear, vanish or jump: all of "
        "the queue, or those of one frame, so that noise falls from frame to frame",
        {"all", "gradual"});
}

Option estimator_option() {
    return own_choice_option(
        "estimator",
        "Photons that each estimate takes: those within one radius, as photons "
        "does, the k nearest, as knn does, or those whose footprints it lies in, "
        "as footprints does",
        {"radius", "knn", "footprints"});
}

Option rebuild_option() {
    return own_choice_option("rebuild",
                             "For comparison: build a tree over all photons of the queue in each "
                             "frame, that of other methods, or a kd-tree over photons",
                             {"off", "lbvh", "kdtree"});
}

Option classify_option() {
    return own_choice_option("classify",
                             "How new photons find their cells: each descends to its cell, or, for "
                             "comparison, each cell tests all photons",
                             {"descent", "leaves"});
}

Option direct_option() {
    return own_choice_option(
        "direct",
        "Where direct light comes from: shadow rays, or, for comparison, photons "
        "that are stored where they are scattered first",
        {"rays", "photons"});
}

Option show_option() {
    return own_choice_option("show",
                             "The picture, or the photons in the map as points of their colour",
                             {"picture", "photons"});
}

Option cells_option() {
    return own_choice_option("queue-cells",
                             "What divides space into the queue's cells first: the kd-tree of the "
                             "triangles, or the photons alone",
                             {"triangles", "photons"});
}

} // namespace

QueueOptions queue_options_of(const RenderSettings& settings) {
    QueueOptions options;
    options.window = static_cast<std::uint32_t>(own_number(settings, window_option()));
    if (half_life_option().get(settings) != "auto") {
        options.half_life = own_number(settings, half_life_option());
    }
    options.fills = fill_option().get(settings) == "all";
    const std::string rebuild = rebuild_option().get(settings);
    options.rebuild = rebuild == "lbvh"     ? QueueRebuild::lbvh
                      : rebuild == "kdtree" ? QueueRebuild::kdtree
                                            : QueueRebuild::none;
    options.classify = classify_option().get(settings) == "leaves" ? QueueClassify::leaves
                                                                   : QueueClassify::descent;
    options.direct = direct_option().get(settings) == "photons";
    options.shows_photons = show_option().get(settings) == "photons";
    if (options.direct && settings.final_gather) {
        throw UsageError("rendering by photon-queue: --direct photons leaves the nearest surface "
                         "to photons, and --final-gather does not; leave out one of them");
    }
    options.cells =
        cells_option().get(settings) == "photons" ? QueueCells::photons : QueueCells::triangles;
    const std::string estimator = estimator_option().get(settings);
    options.estimator = estimator == "knn"          ? QueueEstimator::nearest
                        : estimator == "footprints" ? QueueEstimator::footprints
                                                    : QueueEstimator::radius;
    return options;
}

std::vector<Option> all_queue_options() {
    std::vector<Option> options = all_photon_map_options(
        {window_option(), half_life_option(), fill_option(), estimator_option(), rebuild_option(),
         classify_option(), direct_option(), show_option(), cells_option()});
    // Widths do not fall from frame to frame, and no photon is sorted by a code.
    constexpr std::array<std::string_view, 5> without{"progressive", "passes", "r1",
                                                      "radius-exponent", "wide-codes"};
    std::erase_if(options, [&](const Option& option) {
        return std::find(without.begin(), without.end(), option.name) != without.end();
    });
    for (const Option& option : nearest_options()) {
        options.push_back(option);
    }
    for (Option option : footprint_options()) {
        option.sweep = {}; // they matter to one estimator only
        options.push_back(std::move(option));
    }
    for (const Option& option : fixed_radius_options()) {
        if (option.name == "kernel" || option.name == "support") {
            options.push_back(option);
        }
    }
    return options;
}

} // namespace argand
