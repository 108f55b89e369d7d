#pragma once

#include "autotune/aim.hpp"
#include "device/device.hpp"
#include "methods/render.hpp"

#include <nlohmann/json.hpp>

namespace argand {

/// Wall-clock seconds of the parts of `argand render`.
struct ReportTimes {
    double load = 0, open = 0, render = 0, write = 0;
};

/// The report of `argand render --json`: every parameter, the device, times, photons, memory. `spp`
/// and `photons` are as asked for, `samples_per_pixel` and `photons_emitted` what all passes did;
/// largest footprints are semi-axes of the last pass in the scene's units. Null: no limit of
/// bounces, no time stamps to time a stage by.
nlohmann::ordered_json render_report(Device& device, const Scene& scene,
                                     const RenderSettings& settings, float exposure,
                                     const std::vector<std::string>& outputs,
                                     const RenderStatistics& statistics, const ReportTimes& times);

/// What was asked for, what was picked, what was expected of it and of all else, and what came of
/// it.
nlohmann::ordered_json aim_report(const AimedRender& render);

} // namespace argand
