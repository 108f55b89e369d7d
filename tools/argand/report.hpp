#pragma once

#include "autotune/autotune.hpp"
#include "device/device.hpp"
#include "image/picture_settings.hpp"
#include "methods/method_info.hpp"

#include <nlohmann/json.hpp>

namespace argand {

/// Wall-clock seconds of the parts of `argand render`.
struct ReportTimes {
    double load = 0, open = 0, update = 0, render = 0, write = 0;
    double upload = 0; ///< of the first picture's geometry, until the tree's first kernel is
                       ///< recorded and those after it; part of render
};

/// A finished render.
struct RenderReport {
    Device& device;
    const Scene& scene;
    const MethodInfo& method;
    const RenderSettings& settings;
    Display display;
    const std::vector<std::string>& outputs;
    const RenderStatistics& statistics;
    const ReportTimes& times;
};

/// The report of `argand render --json`: every parameter, the device, times, photons, memory. `spp`
/// and `photons` are as the user asked; `samples_per_pixel` and `photons_emitted` count all passes.
/// Largest footprints are semi-axes of the last pass in scene units. Null means no limit of
/// bounces, or a device without time stamps.
nlohmann::ordered_json render_report(const RenderReport& render);

/// What the user asked for, what was expected of each candidate, and the result.
nlohmann::ordered_json autotune_report(const AutotunedRender& render, MethodTable methods);

} // namespace argand
