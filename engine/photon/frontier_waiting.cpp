#include "device/copy_elements.hpp"
#include "photon/frontier_search.hpp"
#include "shared/frontier.h"
#include "shared/segments.h"

#include <algorithm>
#include <utility>

namespace argand::frontier {

/// Splits a part whose children have more references than there is room for. Returns its first
/// nodes, for whose children there is room; the others wait. If there is room for those of no node,
/// the part is to have fewer.
Part Search::split(const Part& part, std::uint32_t children) {
    const auto ancestors = download<std::uint32_t>(device_, parts_.ancestors, children);
    const auto of_children = download<FrontierNode>(device_, parts_.nodes, children);
    const auto nodes = download<FrontierNode>(device_, now_.nodes, part.end_node);
    const auto ranges = download<SegmentRange>(device_, now_.ranges, part.end_node);
    std::uint32_t child = 0;
    while (of_children[child].first + of_children[child].count <= most_references_) {
        ++child;
    }
    const std::uint32_t node = ancestors[child];
    if (node == ancestors[0]) {
        careful_ = true;
        return part;
    }
    Part taken = part;
    Part rest = part;
    taken.end_node = rest.first_node = node;
    taken.end_query = rest.first_query = ranges[node].first;
    taken.end_photon = rest.first_photon = nodes[node].first;
    rest.active = rest.chunks = 0;
    for (std::uint32_t i = node; i < part.end_node; ++i) {
        if (nodes[i].state == frontier_active) {
            ++rest.active;
            rest.chunks += chunks_of(nodes[i].count, chunk_);
        }
    }
    taken.active -= rest.active;
    taken.chunks -= rest.chunks;
    wait_or_finish(rest);
    return taken;
}

namespace {

/// Copies `count` nodes of a level.
void copy_nodes(Device& device, const Nodes& from, std::uint32_t first, const Nodes& to,
                std::uint32_t place, std::uint32_t count) {
    copy_elements(device, from.ranges, first, to.ranges, place, count, sizeof(SegmentRange));
    copy_elements(device, from.boxes, first, to.boxes, place, count, sizeof(BoxRecord));
    copy_elements(device, from.nodes, first, to.nodes, place, count, sizeof(FrontierNode));
}

} // namespace

/// Keeps a part until resume(). If there is no room for its references, its active nodes become
/// leaves instead, which takes longer but no memory.
void Search::wait_or_finish(const Part& part) {
    const std::uint32_t photons = part.end_photon - part.first_photon;
    const std::uint32_t count = part.end_node - part.first_node;
    const std::uint32_t place = waiting_.empty()
                                    ? 0
                                    : waiting_.back().place + waiting_.back().part.end_photon -
                                          waiting_.back().part.first_photon;
    if (photons > most_references_ - place) {
        auto nodes = download<FrontierNode>(device_, now_.nodes, count, part.first_node);
        std::uint32_t most = 0;
        for (FrontierNode& node : nodes) {
            // The leaves have been added already.
            node.state = node.state == frontier_active ? frontier_leaf : frontier_ended;
            most = node.state == frontier_leaf ? std::max(most, node.count) : most;
        }
        device_.upload(now_.nodes, part.first_node * sizeof(FrontierNode),
                       std::as_bytes(std::span(nodes)));
        add_leaves(part, most);
        return;
    }
    if (!waiting_references_) {
        waiting_references_ =
            device_.allocate("simultaneous search", most_references_ * sizeof(glm::uvec4));
    }
    Waiting waiting{.part = part, .place = place};
    waiting.nodes = {
        .ranges = device_.allocate("simultaneous search", count * sizeof(SegmentRange)),
        .boxes = device_.allocate("simultaneous search", count * sizeof(BoxRecord)),
        .nodes = device_.allocate("simultaneous search", count * sizeof(FrontierNode))};
    copy_nodes(device_, now_, part.first_node, waiting.nodes, 0, count);
    copy_elements(device_, references_, part.first_photon, waiting_references_, place, photons,
                  sizeof(glm::uvec4));
    waiting_.push_back(std::move(waiting));
    if (statistics_ != nullptr) {
        ++statistics_->waits;
    }
}

/// The part that has waited for the shortest time, where it was.
Part Search::resume() {
    const Waiting waiting = std::move(waiting_.back());
    waiting_.pop_back();
    const Part part = waiting.part;
    copy_nodes(device_, waiting.nodes, 0, now_, part.first_node, part.end_node - part.first_node);
    copy_elements(device_, waiting_references_, waiting.place, references_, part.first_photon,
                  part.end_photon - part.first_photon, sizeof(glm::uvec4));
    return part;
}

} // namespace argand::frontier
