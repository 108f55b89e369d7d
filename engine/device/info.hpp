#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace argand {

enum class DeviceKind : std::uint8_t { discrete, integrated, virtual_gpu, cpu, other };

const char* to_string(DeviceKind kind);

/// Optional features for which there are faster code paths. Each path has a fallback, which
/// ARGAND_DISABLE=name,name,... forces.
struct Features {
    bool subgroups = false; ///< arithmetic, ballot and shuffle in compute shaders ("subgroups")
    bool push_descriptors = false; ///< VK_KHR_push_descriptor ("push_descriptors")
    bool timestamps = false;       ///< GPU time stamps ("timestamps")
    bool raster = false;           ///< a rasteriser into layers ("raster")
    bool lane_serial = false;      ///< see DeviceInfo::lane_serial() ("lane_serial")
};

/// Limits of a device. ARGAND_LIMIT=storage_range=1MiB,invocations=128,... lowers them, so that
/// small tests reach splitting and fallbacks.
struct Limits {
    std::uint64_t storage_range = 0;   ///< bytes of one storage buffer binding ("storage_range")
    std::uint64_t memory = 0;          ///< bytes of the device's largest local heap ("memory")
    std::uint32_t invocations = 0;     ///< per work-group ("invocations")
    std::uint32_t shared_memory = 0;   ///< bytes per work-group ("shared_memory")
    std::uint32_t storage_buffers = 0; ///< per shader stage ("storage_buffers")
    std::uint64_t texels = 0; ///< in a buffer that a kernel reads as a utextureBuffer ("texels")
    std::uint32_t groups = 0; ///< work-groups per dimension ("groups")
    std::uint32_t image = 0;  ///< width and height of what the rasteriser draws ("image")
    std::uint32_t layers = 0; ///< that it draws at once ("layers")
};

struct DeviceInfo {
    std::string backend;     ///< one of backend_names()
    std::uint32_t index = 0; ///< index in the list of `argand devices`
    std::string name;
    std::string driver; ///< name and version of the driver
    std::string api_version;
    DeviceKind kind = DeviceKind::other;
    std::uint32_t subgroup_size = 1;
    Features features;
    Limits limits;
    std::string unsuitable; ///< why the device cannot be used; empty if it can

    /// Whether a CPU core runs the lanes of a work-group one after another. There, a contiguous
    /// chunk per lane is faster than co-operation between lanes.
    bool lane_serial() const { return features.lane_serial; }
};

/// Requirements beyond Vulkan 1.2's guarantees, checked when a device is opened.
struct Requirements {
    static constexpr std::uint64_t storage_range = 1ull << 20;
    static constexpr std::uint32_t invocations = 128;
    static constexpr std::uint32_t shared_memory = 16384;
    static constexpr std::uint32_t storage_buffers = 24;
};

/// Applies ARGAND_DISABLE and ARGAND_LIMIT. Throws UsageError for an unknown name or a malformed
/// number.
void apply_environment(DeviceInfo& info);

/// Describes the first requirement that the limits do not meet; empty if they meet all.
std::string unmet_requirement(const Limits& limits);

} // namespace argand
