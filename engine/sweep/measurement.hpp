#pragma once

#include "sweep/reference.hpp"
#include "sweep/sweep.hpp"

#include <nlohmann/json.hpp>

namespace argand {

/// Mean over the seeds and standard deviation of one of them; 0 where there is one seed.
struct Spread {
    double mean = 0;
    double deviation = 0;
};

/// A setting, measured.
struct Measurement {
    std::string key; ///< all its parameters (sweep/parameters.hpp)
    std::string method, knob, value;
    std::string options; ///< of `argand render`
    std::string picture; ///< file of its first seed's picture, relative to the sweep's folder
    std::uint64_t seeds = 0;
    double wall_seconds = 0;              ///< median
    std::optional<double> device_seconds; ///< median
    std::uint64_t peak_bytes = 0;
    Spread rel_mse, ssim;
    std::optional<double> bias,
        variance; ///< squared bias and variance, whose sum is the mean relMSE; none: one seed
};

/// Of pictures of one setting that differ in their seeds alone. The squared bias is estimated
/// without bias, so that it may be less than 0 where there is hardly any.
Measurement measure(const Setting& setting, const Trials& trials, const Reference& reference);

nlohmann::ordered_json to_json(const Measurement& measurement);
/// Throws nlohmann::json::exception if it is not one.
Measurement measurement_from(const nlohmann::ordered_json& json);

} // namespace argand
