#include "device/vulkan/stage_timer.hpp"

#include "device/vulkan/result.hpp"

#include <algorithm>

namespace argand::vulkan {

StageTimer::StageTimer(VkDevice device, bool enabled, double nanoseconds_per_tick,
                       std::uint32_t valid_bits)
    : device_(device), enabled_(enabled && valid_bits > 0),
      seconds_per_tick_(nanoseconds_per_tick * 1e-9),
      mask_(valid_bits >= 64 ? ~std::uint64_t(0) : (std::uint64_t(1) << valid_bits) - 1) {}

void StageTimer::reset(StageQueries& queries, VkCommandBuffer commands) const {
    queries.used = 0;
    queries.stages.clear();
    if (!enabled_) {
        return;
    }
    if (!queries.pool) {
        VkQueryPoolCreateInfo create{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
        create.queryType = VK_QUERY_TYPE_TIMESTAMP;
        create.queryCount = StageQueries::capacity;
        check(vkCreateQueryPool(device_, &create, nullptr, &queries.pool), "creating a query pool");
    }
    vkCmdResetQueryPool(commands, queries.pool, 0, StageQueries::capacity);
}

void StageTimer::begin(std::string_view name) {
    const auto found = std::find_if(times_.begin(), times_.end(),
                                    [&](const StageTime& stage) { return stage.name == name; });
    current_ = static_cast<std::size_t>(found - times_.begin());
    if (found == times_.end()) {
        times_.push_back({std::string(name), 0, 0});
    }
    ++times_[current_].runs;
}

void StageTimer::end() { current_ = none; }

void StageTimer::stamp_begin(StageQueries& queries, VkCommandBuffer commands) const {
    if (enabled_) {
        vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries.pool,
                            queries.used);
        queries.stages.push_back(current_);
        ++queries.used;
    }
}

void StageTimer::stamp_end(StageQueries& queries, VkCommandBuffer commands) const {
    if (enabled_) {
        vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries.pool,
                            queries.used);
        ++queries.used;
    }
}

void StageTimer::collect(const StageQueries& queries) {
    if (!enabled_ || queries.used == 0) {
        return;
    }
    std::vector<std::uint64_t> ticks(queries.used);
    check(vkGetQueryPoolResults(device_, queries.pool, 0, queries.used,
                                ticks.size() * sizeof(std::uint64_t), ticks.data(),
                                sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT),
          "reading GPU time stamps");
    for (std::size_t pair = 0; pair < queries.stages.size(); ++pair) {
        const std::uint64_t elapsed = (ticks[2 * pair + 1] - ticks[2 * pair]) & mask_;
        // lavapipe's clock may run backwards by a few microseconds: stamps come from several
        // threads.
        const bool backwards = elapsed > mask_ / 2;
        if (queries.stages[pair] < times_.size() && !backwards) {
            times_[queries.stages[pair]].seconds +=
                static_cast<double>(elapsed) * seconds_per_tick_;
        }
    }
}

void StageTimer::clear() { times_.clear(); }

} // namespace argand::vulkan
