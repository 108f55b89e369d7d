#include "photon/frontier_search.hpp"
#include "shared/frontier.h"
#include "shared/segments.h"

#include <algorithm>

namespace argand::frontier {

void Search::count_leaves(const Part& part) {
    if (statistics_ == nullptr) {
        return;
    }
    ++statistics_->levels;
    const std::uint32_t count = part.end_node - part.first_node;
    const auto nodes = download<FrontierNode>(device_, now_.nodes, count, part.first_node);
    const auto ranges = download<SegmentRange>(device_, now_.ranges, count, part.first_node);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (nodes[i].state == frontier_leaf) {
            ++statistics_->leaves;
            statistics_->pairs += std::uint64_t(nodes[i].count) * ranges[i].count;
        }
    }
}

/// Counts the references that go to no child, and those that go to several.
void Search::count_photons(const Part& part, std::uint32_t children) {
    if (statistics_ == nullptr) {
        return;
    }
    const auto nodes = download<FrontierNode>(device_, now_.nodes, part.end_node);
    const auto references = download<glm::uvec4>(device_, references_, part.end_photon);
    const auto families = download<glm::uvec2>(device_, families_, part.end_node);
    const auto boxes = download<BoxRecord>(device_, parts_.boxes, children);
    const auto extents = download<glm::vec4>(
        device_, extents_, of_footprints_ ? std::min(photon_count_ - first_photon_, batch_) : 0);
    for (std::uint32_t i = part.first_node; i < part.end_node; ++i) {
        if (nodes[i].state != frontier_active) {
            continue;
        }
        statistics_->references += nodes[i].count;
        for (std::uint32_t j = nodes[i].first; j < nodes[i].first + nodes[i].count; ++j) {
            const glm::vec3 p = glm::uintBitsToFloat(glm::uvec3(references[j]));
            const glm::vec3 extent = of_footprints_
                                         ? glm::vec3(extents[references[j].w - first_photon_])
                                         : glm::vec3(reach_);
            std::uint32_t to = 0;
            for (std::uint32_t c = families[i].x; c < families[i].y; ++c) {
                to += reaches(p, extent, box_low(boxes[c]), box_high(boxes[c])) ? 1 : 0;
            }
            statistics_->box_tests += families[i].y - families[i].x;
            statistics_->discarded += to == 0 ? 1 : 0;
            statistics_->replicated += to > 1 ? to - 1 : 0;
        }
    }
}

} // namespace argand::frontier
