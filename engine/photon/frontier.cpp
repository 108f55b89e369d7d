#include "photon/frontier_search.hpp"

#include "base/error.hpp"
#include "device/copy_elements.hpp"
#include "kernels/frontier_begin.hpp"
#include "kernels/frontier_copy.hpp"
#include "kernels/frontier_count.hpp"
#include "kernels/frontier_divide.hpp"
#include "kernels/frontier_divide_again.hpp"
#include "kernels/frontier_enter.hpp"
#include "kernels/frontier_move.hpp"
#include "kernels/frontier_nodes.hpp"
#include "kernels/frontier_parts.hpp"
#include "kernels/frontier_queries.hpp"
#include "kernels/frontier_root.hpp"
#include "kernels/frontier_sides.hpp"
#include "parallel/scan.hpp"
#include "parallel/segments.hpp"
#include "shared/frontier.h"

#include <algorithm>
#include <utility>

namespace argand {

namespace frontier {

namespace {

// References that an invocation takes. Lanes of a CPU go through memory one after another, each in
// its own stream; those of a GPU should read what lies nearly side by side.
constexpr std::uint32_t chunk_on_cpu = 256;
constexpr std::uint32_t chunk_on_gpu = 16;
// The references of all children of so many are still counted in 32 bits.
constexpr std::uint64_t most_on_any_device = 1u << 28;

} // namespace

Search::Search(Device& device, const PhotonMap& map, const PhotonQueries& queries,
               std::uint32_t query_count, double reach, const FrontierSettings& settings,
               const std::function<void(const FrontierLeaves&)>& add,
               FrontierStatistics* statistics)
    : device_(device), map_(map), queries_(queries), settings_(settings), add_(add),
      statistics_(statistics),
      // Enlarged, for the roundings of differences between positions.
      reach_(static_cast<float>(reach * 1.00001)),
      of_footprints_(static_cast<bool>(map.footprints)),
      chunk_(device.info().lane_serial() ? chunk_on_cpu : chunk_on_gpu), query_count_(query_count),
      photon_count_(download_word(device, map.counters, counter_stored)) {
    limit_ = static_cast<std::uint32_t>(
        std::min({settings.memory / bytes_a_frontier_reference,
                  device.info().limits.storage_range / sizeof(glm::uvec4), most_on_any_device}));
    batch_ = limit_ / 2;
    // Nodes that are partitioned have more than query_leaf queries.
    const std::uint64_t queries_in_all = query_count_;
    most_nodes_ = std::min(most_frontier_children * queries_in_all / (settings.query_leaf + 1),
                           queries_in_all) +
                  most_frontier_children;
    const auto allocate = [&](std::uint64_t count, std::uint64_t bytes) {
        return device.allocate("simultaneous search", count * bytes);
    };
    for (Nodes* some : {&now_, &parts_, &other_parts_}) {
        *some = {.ranges = allocate(most_nodes_, sizeof(SegmentRange)),
                 .boxes = allocate(most_nodes_, sizeof(BoxRecord)),
                 .nodes = allocate(most_nodes_, sizeof(FrontierNode)),
                 .ancestors = allocate(most_nodes_, 4)};
    }
    for (Places& places : places_) {
        places = {.places = allocate(query_count_, sizeof(glm::uvec4)),
                  .segments = allocate(query_count_, 4)};
    }
    copies_ = allocate(most_nodes_, 4);
    first_copies_ = allocate(most_nodes_, 4);
    chunks_ = allocate(most_nodes_, 4);
    first_chunks_ = allocate(most_nodes_, 4);
    families_ = allocate(most_nodes_, 8);
    sources_ = allocate(most_nodes_, 4);
    query_lefts_ = allocate(most_nodes_, 4);
    flags_ = allocate(query_count_, 4);
    flag_sums_ = allocate(query_count_, 4);
    to_ = allocate(query_count_, 4);
    const std::uint64_t together = std::min(std::max(photon_count_, 1u), batch_);
    photon_flags_ = allocate(together, 4);
    photon_sums_ = allocate(together, 4);
    extents_ = allocate(of_footprints_ ? together : 1, sizeof(glm::vec4));
    counters_ = allocate(frontier_counters, 4);
    make_room(std::max<std::uint64_t>(4 * together, least_frontier_references), 0);
}

/// Makes room for about so many references on a level, and keeps the first `kept`.
void Search::make_room(std::uint64_t references, std::uint32_t kept) {
    most_references_ = static_cast<std::uint32_t>(std::min<std::uint64_t>(references, limit_));
    const std::uint64_t chunks = most_references_ / chunk_ + most_nodes_;
    const auto allocate = [&](std::uint64_t count, std::uint64_t bytes) {
        return device_.allocate("simultaneous search", count * bytes);
    };
    // Freed first, for they may be large.
    next_references_ = counts_ = sums_ = waiting_references_ = Buffer();
    const Buffer before = references_;
    references_ = allocate(most_references_, sizeof(glm::uvec4));
    copy_elements(device_, before, 0, references_, 0, kept, sizeof(glm::uvec4));
    next_references_ = allocate(most_references_, sizeof(glm::uvec4));
    chunk_sources_ = allocate(chunks, 4);
    counts_ = allocate(most_frontier_children * chunks, 4);
    sums_ = allocate(most_frontier_children * chunks, 4);
}

FrontierParams Search::params(std::uint32_t first, std::uint32_t end) const {
    return {.first = first,
            .end = end,
            .query_leaf = settings_.query_leaf,
            .cost = settings_.partition_cost,
            .reach = reach_,
            .part = queries_.part,
            .flatness = map_.flatness,
            .chunk = chunk_};
}

std::vector<std::uint32_t> Search::read_counters() {
    return download<std::uint32_t>(device_, counters_, frontier_counters);
}

void Search::run() {
    std::uint32_t first = 0;
    do {
        dispatch(device_,
                 kernels::frontier_queries{.active_slots = queries_.slots,
                                           .queries = queries_.points,
                                           .places = places_[0].places,
                                           .segments = places_[0].segments,
                                           .gathers = queries_.suspended,
                                           .params = params(first, query_count_)},
                 query_count_);
        const std::uint32_t end = first + std::min(batch_, photon_count_ - first);
        if (end > first) {
            search_among(first, end);
        }
        first = end;
    } while (first < photon_count_);
}

/// Searches among the photons first <= i < end of the map.
void Search::search_among(std::uint32_t first, std::uint32_t end) {
    first_photon_ = first;
    segment_boxes(device_, places_[0].places, Lanes::point,
                  {.of_elements = places_[0].segments, .end = query_count_}, 1, now_.boxes);
    dispatch(device_,
             kernels::frontier_enter{.photons = map_.photons,
                                     .boxes = now_.boxes,
                                     .flags = photon_flags_,
                                     .footprints = of_footprints_ ? map_.footprints : map_.photons,
                                     .extents = extents_,
                                     .params = params(first, end),
                                     .constants = {.of_footprints = of_footprints_}},
             end - first);
    exclusive_scan(device_, photon_flags_, photon_sums_, end - first);
    dispatch(device_,
             kernels::frontier_root{.photons = map_.photons,
                                    .flags = photon_flags_,
                                    .sums = photon_sums_,
                                    .references = references_,
                                    .params = params(first, end)},
             end - first);
    dispatch(device_,
             kernels::frontier_begin{.boxes = now_.boxes,
                                     .flags = photon_flags_,
                                     .sums = photon_sums_,
                                     .ranges = now_.ranges,
                                     .nodes = now_.nodes,
                                     .counters = counters_,
                                     .params = params(end - first, query_count_)},
             1);
    const auto counters = read_counters();
    const Part root{.end_node = 1,
                    .end_query = query_count_,
                    .end_photon = counters[frontier_references],
                    .active = counters[frontier_parents],
                    .chunks = counters[frontier_chunks]};
    if (statistics_ != nullptr) {
        statistics_->photons += end - first;
        statistics_->entered += root.end_photon;
        statistics_->box_tests += end - first;
    }
    add_leaves(root, ~counters[frontier_most]);
    take_levels(root);
}

/// Divides a part of a level until no node is active, and then the parts that waited meanwhile.
void Search::take_levels(Part part) {
    for (;;) {
        while (part.active == 0) {
            if (waiting_.empty()) {
                return;
            }
            part = resume();
        }
        Part next = part;
        const std::uint32_t children = divide_queries(next);
        divide_photons(part, children);
        const auto counters = read_counters();
        const std::uint32_t references = counters[frontier_references];
        if (references > most_references_ && waiting_.empty() && most_references_ < limit_) {
            make_room(2 * std::uint64_t(references), part.end_photon);
            continue;
        }
        if (references > most_references_) {
            part = split(part, children);
            continue;
        }
        careful_ = false;
        count_photons(part, children);
        dispatch(device_,
                 kernels::frontier_copy{.references = references_,
                                        .sources = chunk_sources_,
                                        .first_chunks = first_chunks_,
                                        .nodes = now_.nodes,
                                        .families = families_,
                                        .boxes = parts_.boxes,
                                        .extents = extents_,
                                        .places = sums_,
                                        .next_references = next_references_,
                                        .params = params(first_photon_, part.chunks),
                                        .constants = {.of_footprints = of_footprints_}},
                 part.chunks);
        std::swap(now_, parts_);
        std::swap(references_, next_references_);
        part = {.side = next.side,
                .end_node = children,
                .first_query = part.first_query,
                .end_query = part.end_query,
                .end_photon = references,
                .active = counters[frontier_parents],
                .chunks = counters[frontier_chunks]};
        add_leaves(part, ~counters[frontier_most]);
        device_.submit();
    }
}

/// Partitions the queries of active nodes, and the parts again, as often as the settings say. The
/// parts are the children of the nodes. Returns their number.
std::uint32_t Search::divide_queries(Part& part) {
    dispatch(device_,
             kernels::frontier_divide{.nodes = now_.nodes,
                                      .copies = copies_,
                                      .chunks = chunks_,
                                      .params = params(part.first_node, part.end_node)},
             part.end_node);
    expand(device_, chunks_, part.end_node, part.chunks, first_chunks_, chunk_sources_);
    const std::uint32_t side = part.side;
    std::uint32_t parts = partition_queries(part, side, part.end_node, 2 * part.active, false);
    for (std::uint32_t k = 1; k < settings_.partitions && !careful_; ++k) {
        upload_word(device_, counters_, frontier_parents, 0);
        dispatch(device_,
                 kernels::frontier_divide_again{.ranges = parts_.ranges,
                                                .boxes = parts_.boxes,
                                                .copies = copies_,
                                                .counters = counters_,
                                                .params = params(0, parts)},
                 parts);
        const std::uint32_t again = download_word(device_, counters_, frontier_parents);
        if (again == 0) {
            break;
        }
        parts = partition_queries(part, side, parts, parts + again, true);
    }
    return parts;
}

/// Makes `parts` parts of `nodes` nodes, or of parts of nodes, as copies_ says. They become parts_.
/// level_side: where the level's queries are.
std::uint32_t Search::partition_queries(Part& part, std::uint32_t level_side, std::uint32_t nodes,
                                        std::uint32_t parts, bool again) {
    const Nodes& from = again ? parts_ : now_;
    // The queries of the level stay where they are, for they may be divided again (split()).
    const std::uint32_t side = again ? 3 - level_side - part.side : (level_side + 1) % 3;
    const Places& queries = places_[part.side];
    const Places& next = places_[side];
    const FrontierParams of_queries = params(part.first_query, part.end_query);
    const std::uint64_t query_threads = part.end_query - part.first_query;
    expand(device_, copies_, nodes, parts, first_copies_, sources_);
    dispatch(device_,
             kernels::frontier_sides{.places = queries.places,
                                     .segments = queries.segments,
                                     .copies = copies_,
                                     .boxes = from.boxes,
                                     .flags = flags_,
                                     .params = of_queries},
             query_threads);
    partition_segments(device_, flags_,
                       {.of_elements = queries.segments,
                        .ranges = from.ranges,
                        .first = part.first_query,
                        .end = part.end_query},
                       flag_sums_, to_, query_lefts_);
    dispatch(device_,
             kernels::frontier_move{.places = queries.places,
                                    .segments = queries.segments,
                                    .copies = copies_,
                                    .parts = first_copies_,
                                    .flags = flags_,
                                    .to = to_,
                                    .next_places = next.places,
                                    .next_segments = next.segments,
                                    .params = of_queries},
             query_threads);
    dispatch(device_,
             kernels::frontier_parts{.sources = sources_,
                                     .ranges = from.ranges,
                                     .copies = copies_,
                                     .parts = first_copies_,
                                     .lefts = query_lefts_,
                                     .ancestors = from.ancestors,
                                     .next_ranges = other_parts_.ranges,
                                     .next_ancestors = other_parts_.ancestors,
                                     .families = families_,
                                     .params = params(again ? 1 : 0, parts)},
             parts);
    segment_boxes(device_, next.places, Lanes::point,
                  {.of_elements = next.segments, .first = part.first_query, .end = part.end_query},
                  parts, other_parts_.boxes);
    std::swap(parts_, other_parts_);
    part.side = side;
    return parts;
}

/// Counts the photons that go to each child, and decides what becomes of the children.
void Search::divide_photons(const Part& part, std::uint32_t children) {
    dispatch(device_,
             kernels::frontier_count{.references = references_,
                                     .sources = chunk_sources_,
                                     .first_chunks = first_chunks_,
                                     .nodes = now_.nodes,
                                     .families = families_,
                                     .boxes = parts_.boxes,
                                     .extents = extents_,
                                     .counts = counts_,
                                     .params = params(first_photon_, part.chunks),
                                     .constants = {.of_footprints = of_footprints_}},
             part.chunks);
    exclusive_scan(device_, counts_, sums_, most_frontier_children * part.chunks);
    device_.fill(BufferView(counters_, 0, frontier_most * 4), 0);
    upload_word(device_, counters_, frontier_most, 0xffffffffu);
    dispatch(device_,
             kernels::frontier_nodes{.ancestors = parts_.ancestors,
                                     .first_chunks = first_chunks_,
                                     .nodes = now_.nodes,
                                     .families = families_,
                                     .ranges = parts_.ranges,
                                     .boxes = parts_.boxes,
                                     .counts = counts_,
                                     .sums = sums_,
                                     .next_nodes = parts_.nodes,
                                     .counters = counters_,
                                     .params = params(0, children)},
             children);
}

void Search::add_leaves(const Part& part, std::uint32_t most_photons) {
    count_leaves(part);
    if (most_photons > 0) {
        add_({.places = places_[part.side].places,
              .segments = places_[part.side].segments,
              .nodes = now_.nodes,
              .references = references_,
              .first = part.first_query,
              .end = part.end_query,
              .most_photons = most_photons});
    }
}

} // namespace frontier

std::uint32_t search_simultaneously(Device& device, const PhotonMap& map,
                                    const PhotonQueries& queries, double reach,
                                    const FrontierSettings& settings,
                                    const std::function<void(const FrontierLeaves&)>& add,
                                    FrontierStatistics* statistics) {
    if (settings.memory < least_frontier_memory) {
        fail("answering queries simultaneously: {} bytes are too few for the frontier; it takes {} "
             "at least",
             settings.memory, least_frontier_memory);
    }
    const std::uint32_t count = download_word(device, queries.count.buffer, queries.count.index);
    if (count > 0) {
        frontier::Search(device, map, queries, count, reach, settings, add, statistics).run();
    }
    return count;
}

} // namespace argand