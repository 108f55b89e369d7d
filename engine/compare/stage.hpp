#pragma once

#include "device/device.hpp"

#include <string>
#include <vector>

namespace argand {

/// Names of the stages that are no kernels.
inline constexpr const char* sort_stage = "sort";
inline constexpr const char* scan_stage = "scan";
inline constexpr const char* segmented_scan_stage = "segmented scan";
inline constexpr const char* reduce_stage = "reduce";
inline constexpr const char* reduce_box_stage = "reduce boxes";
inline constexpr const char* compact_stage = "compact";

/// The stage that a kernel is: its variant for texels is the same.
std::string stage_name(const KernelInfo& kernel);

/// A buffer that a kernel writes.
struct WrittenBinding {
    BufferView view;
    std::string name;
    std::string layout; ///< an item's words: 'f' a float, 'u' any other
};

/// What a kernel writes, each buffer once: what it does not need is bound to one that is bound
/// anyway.
std::vector<WrittenBinding> written_bindings(const KernelInfo& kernel,
                                             const KernelArguments& arguments);

} // namespace argand
