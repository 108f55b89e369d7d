#pragma once

#include "device/device.hpp"

#include <vector>

namespace argand {

/// Names of the stages that are primitives, not kernels.
inline constexpr const char* sort_stage = "sort";
inline constexpr const char* scan_stage = "scan";
inline constexpr const char* segmented_scan_stage = "segmented scan";
inline constexpr const char* reduce_stage = "reduce";
inline constexpr const char* reduce_box_stage = "reduce boxes";
inline constexpr const char* compact_stage = "compact";

/// A buffer that a stage writes.
struct WrittenBinding {
    BufferView view;
    KernelBinding how; ///< the kernel's declaration; a primitive writes plain words
};

/// The buffers that a kernel writes, each once: a kernel that does not need one of its buffers may
/// get another one in its place.
std::vector<WrittenBinding> written_bindings(const KernelInfo& kernel,
                                             const KernelArguments& arguments);

} // namespace argand
