#pragma once

#include "device/device.hpp"
#include "methods/render.hpp"

#include <nlohmann/json.hpp>

namespace argand {

/// Wall-clock seconds of the parts of `argand render`.
struct ReportTimes {
    double load = 0, open = 0, render = 0, write = 0;
};

/// The report of `argand render --json`: every parameter, the device, times, photons, memory. Null: no limit of bounces,
/// no time stamps to time a stage by.
nlohmann::ordered_json render_report(Device& device, const Scene& scene, const RenderSettings& settings, float exposure,
                                     const std::vector<std::string>& outputs, const RenderStatistics& statistics,
                                     const ReportTimes& times);

} // namespace argand
