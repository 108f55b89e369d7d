#pragma once

#include "sweep/reference.hpp"
#include "sweep/sweep.hpp"

#include <nlohmann/json.hpp>

namespace argand {

/// Mean over the seeds, and standard deviation of a single seed: 0 if there is only one.
struct Spread {
    double mean = 0;
    double deviation = 0;
};

/// The cost and the error of a setting.
struct Measurement {
    std::string key; ///< parameter_key() of the setting
    std::string method, option, value;
    std::string options; ///< of `argand render`
    std::string
        picture; ///< file with the picture of the first seed, relative to the sweep's folder
    std::uint64_t seeds = 0;
    double wall_seconds = 0;              ///< median
    std::optional<double> device_seconds; ///< median
    std::uint64_t peak_bytes = 0;
    Spread rel_mse, ssim;
    /// Squared bias and variance, whose sum is the mean relMSE. None if there is only one seed.
    std::optional<double> bias, variance;
};

/// Measures a setting from trials that differ only in their seeds. The estimate of the squared bias
/// is itself unbiased, so it may be negative where there is hardly any bias.
Measurement measure(const Setting& setting, const Trials& trials, const Reference& reference);

nlohmann::ordered_json to_json(const Measurement& measurement);
/// Throws nlohmann::json::exception if it is not one.
Measurement measurement_from(const nlohmann::ordered_json& json);

} // namespace argand
