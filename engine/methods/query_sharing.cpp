#include "methods/query_sharing.hpp"

#include "kernels/estimate_add.hpp"
#include "kernels/query_cells.hpp"
#include "kernels/query_owners.hpp"
#include "methods/render_settings.hpp"
#include "parallel/compact.hpp"
#include "shared/query_record.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <vector>

namespace argand {

namespace {

/// The queries that are answered together.
struct Round {
    std::uint32_t kind = query_kind_map; ///< query_kind_*
    std::uint32_t part = map_whole;
    double cell = 0;
    bool pixel_sized = false;
    double least_coverage = 0;                                  ///< of an answer that is taken
    float most_uneven = std::numeric_limits<float>::infinity(); ///< the same
};

QueryShareParams share_params(const EyeQueries& queries, const Round& round) {
    QueryShareParams p{.pixel = 3e38f};
    p.query_kind = round.kind;
    p.cell = round.cell > 0 ? std::max(static_cast<float>(round.cell), 1e-30f) : 0;
    if (round.pixel_sized) {
        const CameraRecord& view = queries.view;
        const double across = glm::length(glm::dvec3(view.across_x, view.across_y, view.across_z));
        p.pixel = static_cast<float>(across * view.origin_share);
        p.pixel_slope = static_cast<float>(across * (1 - view.origin_share));
        p.eye_x = view.origin_x;
        p.eye_y = view.origin_y;
        p.eye_z = view.origin_z;
    }
    p.mask = static_cast<std::uint32_t>(queries.cells.size() / 4 - 1);
    return p;
}

/// Finds for each query the slot whose estimate it takes, and marks the queries to be answered.
void find_sources(Device& device, const EyeQueries& queries, const WaitingPaths& paths,
                  const Round& round) {
    const StageScope stage(device, "share queries");
    const QueryShareParams params = share_params(queries, round);
    if (round.cell > 0) {
        device.fill(queries.cells, no_query);
        device.fill(queries.owners, no_query);
    }
    dispatch_indirect(device,
                      kernels::query_cells{.active_slots = paths.slots,
                                           .counts = paths.counts,
                                           .query_kinds = queries.kinds,
                                           .queries = queries.points,
                                           .table = queries.cells,
                                           .owners = queries.owners,
                                           .sources = queries.sources,
                                           .query_bsdfs = queries.bsdfs,
                                           .params = params},
                      paths.counts);
    dispatch_indirect(device,
                      kernels::query_owners{.active_slots = paths.slots,
                                            .counts = paths.counts,
                                            .owners = queries.owners,
                                            .query_kinds = queries.kinds,
                                            .sources = queries.sources,
                                            .chosen = queries.chosen,
                                            .params = params},
                      paths.counts);
}

void answer_round(Device& device, const EyeQueries& queries, const WaitingPaths& paths,
                  const Round& round, const PhotonMap& map, PhotonEstimator& estimator) {
    find_sources(device, queries, paths, round);
    {
        const StageScope stage(device, "compact");
        compact(device, queries.chosen, paths.slots, queries.slots,
                {paths.counts, counts_of_queries}, Count(paths.counts, 0, paths.most));
    }
    estimator.estimate(map, {.points = queries.points,
                             .bsdfs = queries.bsdfs,
                             .slots = queries.slots,
                             .count = Count(paths.counts, counts_of_queries, paths.most),
                             .estimates = queries.estimates,
                             .suspended = queries.suspended,
                             .unfinished = paths.traversal.unfinished,
                             .until_complete = paths.traversal.careful,
                             .part = round.part,
                             .limits_scatterings = round.kind == query_kind_gathers &&
                                                   paths.bounces < unlimited_bounces});
    const StageScope stage(device, "share queries");
    dispatch_indirect(
        device,
        kernels::estimate_add{.active_slots = paths.slots,
                              .counts = paths.counts,
                              .sources = queries.sources,
                              .queries = queries.points,
                              .estimates = queries.estimates,
                              .layers = paths.layers,
                              .paths = paths.records,
                              .params = {.least_coverage = static_cast<float>(round.least_coverage),
                                         .most_uneven = round.most_uneven}},
        paths.counts);
}

} // namespace

EyeQueries make_eye_queries(Device& device, const Plan& plan, std::uint64_t slots,
                            const CameraRecord& view) {
    EyeQueries q{.view = view, .final_gather = plan.needs(Feature::final_gather)};
    // Light paths are aimed at casters of caustics near such points.
    const bool needed = plan.needs(Feature::photon_map) ||
                        (plan.needs(Feature::light_paths) && plan.needs(Feature::caustics));
    // A kernel takes at least an element of each of its buffers.
    const auto per_slot = [&](const char* name, std::uint64_t bytes, bool all = true) {
        return device.allocate(name, (all ? slots : 1) * bytes);
    };
    const bool glossy = needed && plan.needs(Feature::glossy_estimates);
    q.points = per_slot("photon map queries", sizeof(QueryRecord), needed);
    q.bsdfs = per_slot("query BSDFs", sizeof(QueryBsdfRecord), glossy);
    q.kinds = per_slot("kinds of queries", 4, needed);
    if (needed) {
        std::vector<std::uint32_t> all(slots);
        std::iota(all.begin(), all.end(), 0u);
        q.all = upload<std::uint32_t>(device, "slots of eye paths", all);
        q.chosen = per_slot("eye path flags", 4);
        q.slots = per_slot("querying eye paths", 4);
        q.estimates = per_slot("photon map answers", sizeof(EstimateRecord));
        q.suspended = per_slot("unfinished query sums", sizeof(GatherRecord));
        q.sources = per_slot("photon map answers' slots", 4);
        const std::uint64_t entries = std::bit_ceil(slots + 1);
        q.cells = device.allocate("cells of queries", entries * 4);
        q.owners = device.allocate("owners of cells", entries * 4);
    }
    return q;
}

void answer_queries(Device& device, const Plan& plan, const EyeQueries& queries,
                    const WaitingPaths& paths, const PhotonLookup& lookup) {
    const QuerySharing& sharing = queries.sharing;
    const bool takes_all = lookup.untaken.often == untaken_never;
    const double least = lookup.untaken.least_coverage;
    const float most_uneven =
        takes_all ? std::numeric_limits<float>::infinity() : lookup.untaken.most_uneven;
    if (!queries.final_gather) {
        answer_round(device, queries, paths,
                     {.part = sharing.caustics_apart ? map_indirect : map_whole,
                      .cell = sharing.cell,
                      .least_coverage = least,
                      .most_uneven = most_uneven},
                     lookup.map, lookup.estimator);
    }
    if (queries.final_gather ? plan.needs(Feature::caustics) : sharing.caustics_apart) {
        answer_round(device, queries, paths,
                     {.kind = queries.final_gather ? query_kind_caustics : query_kind_map,
                      .part = sharing.caustics_apart ? map_caustic : map_whole,
                      .cell = sharing.caustics_apart && !sharing.sharp_caustics ? sharing.cell : 0,
                      .pixel_sized = true},
                     lookup.map, lookup.estimator);
    }
    // A path's first estimated vertex leaves no such query.
    const bool gathers = !paths.first && (queries.final_gather || !takes_all);
    if (gathers) {
        answer_round(device, queries, paths,
                     {.kind = query_kind_gathers,
                      .cell = sharing.cell,
                      .least_coverage = least,
                      .most_uneven = most_uneven},
                     lookup.map, lookup.gathering_estimator());
    }
}

} // namespace argand
