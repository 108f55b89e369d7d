#pragma once

#include "device/device.hpp"
#include "methods/render_result.hpp"
#include "methods/render_settings.hpp"
#include "scene/scene.hpp"

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
    double wall_seconds = 0;              ///< of rendering, including the upload of the scene
    std::optional<double> device_seconds; ///< of the device's stages; none: it has no time stamps
    RenderStatistics statistics;
};

/// The renders of one setting, one for each seed.
struct Trials {
    std::vector<Trial> trials;
    std::uint64_t peak_bytes = 0; ///< of device memory
};

/// Renders these settings once for each seed. Returns nothing if it was interrupted.
using RenderTrials = std::function<std::optional<Trials>(const RenderSettings& settings,
                                                         std::span<const std::uint32_t> seeds)>;

using OpenDevice = std::function<std::unique_ptr<Device>()>;

/// Runs trials on a device that is opened anew for each setting, so that each setting's memory is
/// counted separately. A small render, which is not measured, compiles the kernels first. Stops
/// between steps when `keep_going` returns false.
RenderTrials trials_on_device(const OpenDevice& open, const Scene& scene,
                              const std::function<bool()>& keep_going,
                              MethodTable methods = builtin_methods());

} // namespace argand
