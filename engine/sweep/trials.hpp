#pragma once

#include "device/device.hpp"
#include "methods/render.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace argand {

/// One render of a setting.
struct Trial {
    Image picture;
    double wall_seconds = 0;              ///< of rendering, with the upload of the scene
    std::optional<double> device_seconds; ///< in the device's stages; none: it has no time stamps
    RenderStatistics statistics;
};

/// Renders of one setting, one for each seed.
struct Trials {
    std::vector<Trial> trials;
    std::uint64_t peak_bytes = 0; ///< of device memory
};

/// Renders these settings once for each seed; nothing if it was interrupted.
using RenderTrials = std::function<std::optional<Trials>(const RenderSettings& settings,
                                                         std::span<const std::uint32_t> seeds)>;

using OpenDevice = std::function<std::unique_ptr<Device>()>;

/// Trials on a device that is opened anew for each setting, so that no setting's memory is counted
/// for another. A small render that is not measured comes first, in which kernels are compiled.
/// `go_on` is asked between steps.
RenderTrials trials_on_device(const OpenDevice& open, const Scene& scene,
                              const std::function<bool()>& go_on,
                              MethodTable methods = builtin_methods());

} // namespace argand
