#pragma once

#include "device/device.hpp"

#include <string>
#include <string_view>
#include <vector>
#include <volk.h>

namespace argand::vulkan {

/// Time stamp queries of one submission: pairs of queries, each pair belonging to a stage.
struct StageQueries {
    static constexpr std::uint32_t capacity = 512;

    VkQueryPool pool = VK_NULL_HANDLE;
    std::vector<std::size_t> stages; ///< stage of each pair
    std::uint32_t used = 0;
};

/// Sums GPU time by stage. A stage that is open when commands are submitted continues in the next
/// submission.
class StageTimer {
public:
    StageTimer(VkDevice device, bool enabled, double nanoseconds_per_tick,
               std::uint32_t valid_bits);

    void reset(StageQueries& queries, VkCommandBuffer commands) const;
    void begin(std::string_view name);
    void end();
    bool open() const { return current_ != none; }
    void stamp_begin(StageQueries& queries, VkCommandBuffer commands) const;
    void stamp_end(StageQueries& queries, VkCommandBuffer commands) const;
    /// Adds the queries of a completed submission to the times.
    void collect(const StageQueries& queries);

    const std::vector<StageTime>& times() const { return times_; }
    void clear();

private:
    static constexpr std::size_t none = SIZE_MAX;

    VkDevice device_;
    bool enabled_;
    double seconds_per_tick_;
    std::uint64_t mask_;
    std::vector<StageTime> times_;
    std::size_t current_ = none;
};

} // namespace argand::vulkan
